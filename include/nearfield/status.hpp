#pragma once

#include <nearfield/export.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Errors as values. No exception crosses the interface of nearfield: whatever can fail returns a
/// Status, or an Expected that holds either a value or the Status that says why there is none.

namespace nearfield {

/// What kind of thing went wrong.
enum class StatusCode {
    ok,                ///< nothing
    invalid_shape,     ///< the rings of a shape cannot be used (not finite, too few vertices, ...)
    invalid_query,     ///< a query's own numbers cannot be used (tolerance, pose, rectangle, ...)
    unknown_shape,     ///< a handle that was never given out, or whose shape was removed
    invalid_settings,  ///< a setting of a context cannot be used (frames in flight, ...)
    invalid_submission,  ///< what came with a batch cannot be used (semaphore, frame, ...)
    unknown_ticket,      ///< a ticket that was never given out, or was collected already
    ring_full,           ///< as many batches are in flight as may be; one has to be collected first
    not_ready,       ///< the frame of a recorded batch is not complete, or batches are in flight
    not_executed,    ///< the commands recorded for a batch were never executed
    not_recordable,  ///< a query takes more than one submission, and so cannot be recorded
    too_large,       ///< the answer would need more memory than the stated limit
    no_device,       ///< no Vulkan driver, or no device in it, that could be used
    unsupported_device,  ///< the device lacks something the base needs; the reasons name all of it
    unsupported_strategy,   ///< the device lacks what a query's strategy needs; the reasons name it
    unsupported_technique,  ///< the context has no device, or was made without a query's technique
    out_of_memory,          ///< host or device memory ran out
    device_lost,            ///< the device was lost; the context can only be destroyed
    device_error,           ///< any other Vulkan call failed; the message names the call and result
    unavailable,     ///< this build of the library does not have it; the message says what would
    invalid_shader,  ///< the source of a shader cannot be compiled; the reasons are the compiler's
};

/// The name of a code as it stands in the enumeration ("invalid_shape").
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(StatusCode code) noexcept;

/// Success, or an error with one message for people and every single reason behind it.
class [[nodiscard]] NEARFIELD_EXPORT Status {
public:
    /// Success.
    Status() = default;

    /// An error without words, for where there is no memory for any.
    explicit Status(StatusCode code) noexcept : code_(code) {}

    /// An error. `message` says what failed, where and why; `reasons` lists each cause where
    /// there can be several (all the features a device lacks, say).
    Status(StatusCode code, std::string message, std::vector<std::string> reasons = {});

    /// True of success.
    [[nodiscard]] bool ok() const noexcept { return code_ == StatusCode::ok; }
    /// StatusCode::ok of success.
    [[nodiscard]] StatusCode code() const noexcept { return code_; }
    /// What failed, where and why; empty of success. Borrowed, as the reasons are, from the status.
    [[nodiscard]] const std::string& message() const noexcept;
    /// Every single cause, where there can be several.
    [[nodiscard]] const std::vector<std::string>& reasons() const noexcept;

    /// Code, message and reasons in one text, a reason a line.
    [[nodiscard]] std::string text() const;

private:
    struct Words;
    [[nodiscard]] const Words& words() const noexcept;

    StatusCode code_ = StatusCode::ok;
    // Kept elsewhere: success, which is checked for every query, is to cost nothing.
    std::shared_ptr<const Words> words_;
};

/// A value, or the error that stands in its place.
///
/// Precondition of value(), `*` and `->`: ok() is true.
template <class Value>
class [[nodiscard]] Expected {
public:
    /// A value; not explicit, so that a function can return it as it is.
    Expected(Value value) : value_(std::move(value)) {}
    /// An error. Precondition: it is not success.
    Expected(Status error) : status_(std::move(error)) {}

    /// True where there is a value.
    [[nodiscard]] bool ok() const noexcept { return value_.has_value(); }
    /// Why there is no value; success where there is one.
    [[nodiscard]] const Status& status() const noexcept { return status_; }

    /// The value, which stays where it is; moved from where the Expected is a temporary.
    [[nodiscard]] Value& value() & noexcept { return *value_; }
    /// Likewise.
    [[nodiscard]] const Value& value() const& noexcept { return *value_; }
    /// Likewise.
    [[nodiscard]] Value&& value() && noexcept { return std::move(*value_); }
    /// The value, as value() gives it.
    [[nodiscard]] Value& operator*() & noexcept { return *value_; }
    /// Likewise.
    [[nodiscard]] const Value& operator*() const& noexcept { return *value_; }
    /// Likewise.
    [[nodiscard]] Value&& operator*() && noexcept { return std::move(*value_); }
    /// A member of the value.
    [[nodiscard]] Value* operator->() noexcept { return &*value_; }
    /// Likewise.
    [[nodiscard]] const Value* operator->() const noexcept { return &*value_; }

private:
    std::optional<Value> value_;
    Status status_;
};

}  // namespace nearfield
