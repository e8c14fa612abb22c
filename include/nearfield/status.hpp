#pragma once

#include <nearfield/export.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Errors as values. No exception crosses the public API: a call that can fail returns a Status, or
/// an Expected that holds either a value or the Status of the failure.

namespace nearfield {

/// Kinds of errors.
enum class StatusCode {
    ok,                ///< no error
    invalid_shape,     ///< invalid rings or paths (not finite, too few vertices, ...)
    invalid_query,     ///< invalid values in a query (tolerance, pose, rectangle, ...)
    unknown_shape,     ///< a handle that was never issued, or whose shape was removed
    unknown_instance,  ///< an instance handle that was never issued, or whose instance was removed
    invalid_settings,  ///< invalid settings of a context, or an invalid structure of a host
    invalid_submission,  ///< an invalid semaphore, command buffer or frame; no queue to submit to
    unknown_ticket,      ///< a ticket that was never issued, or was already collected
    ring_full,           ///< the limit of batches in flight is reached; collect one first
    not_ready,           ///< a recorded batch's frame is not complete, or batches are in flight
    not_executed,        ///< the commands recorded for a batch were never executed
    too_large,           ///< more memory, or a larger output, than a stated limit allows
    no_device,           ///< no Vulkan loader, driver or device, or a context without one
    unsupported_device,  ///< the device does not meet the base; the reasons list everything missing
    unsupported_strategy,   ///< the device lacks what a query's strategy needs; see the reasons
    unsupported_technique,  ///< the context does not have the technique that a query needs
    out_of_memory,          ///< host or device memory ran out
    device_lost,            ///< the device was lost; the context can only be destroyed
    device_error,      ///< another Vulkan call failed; the message names the call and its result
    unavailable,       ///< not in this build; the message says what provides it
    invalid_shader,    ///< a shader does not compile; the reasons are the compiler's messages
    cancelled,         ///< the caller cancelled the call (Limits::cancel) before this was done
    budget_exhausted,  ///< the time budget of the call (Limits::seconds) ended before
    overflow,          ///< recorded commands found more than their memory holds; record again
};

/// The name of a code as in the enumeration, e.g. "invalid_shape".
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(StatusCode code) noexcept;

/// Success, or an error with a message and the list of its causes.
class [[nodiscard]] NEARFIELD_EXPORT Status {
public:
    /// Success.
    Status() = default;

    /// An error without a message, for when there is no memory for one.
    explicit Status(StatusCode code) noexcept : code_(code) {}

    /// An error. `message` states what failed, where and why; `reasons` lists each cause if there
    /// can be several (for example all features that a device lacks).
    Status(StatusCode code, std::string message, std::vector<std::string> reasons = {});

    /// True on success.
    [[nodiscard]] bool ok() const noexcept { return code_ == StatusCode::ok; }
    /// The kind of error; StatusCode::ok on success.
    [[nodiscard]] StatusCode code() const noexcept { return code_; }
    /// What failed, where and why; empty on success. Borrowed from the status.
    [[nodiscard]] const std::string& message() const noexcept;
    /// The causes, if there can be several; otherwise empty. Borrowed from the status.
    [[nodiscard]] const std::vector<std::string>& reasons() const noexcept;

    /// Code, message and reasons as one text, one reason per line.
    [[nodiscard]] std::string text() const;

private:
    struct Words;
    [[nodiscard]] const Words& words() const noexcept;

    StatusCode code_ = StatusCode::ok;
    // Allocated separately: success, which is checked for every query, costs nothing.
    std::shared_ptr<const Words> words_;
};

/// A value, or the error that prevented it. Its members are named and mean what they do in
/// std::expected of C++23, except value(), which would throw, and error(), which can be called
/// either way.
///
/// Precondition of `*` and `->`: has_value() is true.
template <class Value>
class [[nodiscard]] Expected {
public:
    /// A value. Not explicit, so that a function can return it directly.
    Expected(Value value) : value_(std::move(value)) {}
    /// An error. Precondition: `error` is not success.
    Expected(Status error) : error_(std::move(error)) {}

    /// True if there is a value.
    [[nodiscard]] bool has_value() const noexcept { return value_.has_value(); }
    /// True if there is a value, as has_value().
    [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
    /// The error; success (Status::ok()) if there is a value.
    [[nodiscard]] const Status& error() const noexcept { return error_; }

    /// The value, by reference.
    [[nodiscard]] Value& operator*() & noexcept { return *value_; }
    /// The value of a constant Expected, by reference.
    [[nodiscard]] const Value& operator*() const& noexcept { return *value_; }
    /// The value of a temporary, as an rvalue.
    [[nodiscard]] Value&& operator*() && noexcept { return std::move(*value_); }
    /// A member of the value.
    [[nodiscard]] Value* operator->() noexcept { return &*value_; }
    /// A member of the value of a constant Expected.
    [[nodiscard]] const Value* operator->() const noexcept { return &*value_; }

private:
    std::optional<Value> value_;
    Status error_;
};

}  // namespace nearfield
