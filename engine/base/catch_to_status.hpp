#pragma once

#include <engine/base/status_exception.hpp>
#include <nearfield/status.hpp>

#include <exception>
#include <new>
#include <optional>
#include <utility>

namespace nearfield {

/// Runs an action and turns anything it throws into a status: no exception crosses the public
/// interface. If there is no memory for the message, the status has none.
template <class Action>
Status catch_to_status(Action&& action) noexcept {
    try {
        try {
            action();
            return {};
        } catch (const StatusException& failure) {
            return failure.status();
        } catch (const std::bad_alloc&) {
            return {StatusCode::out_of_memory, "the host has no memory left"};
        } catch (const std::exception& error) {
            return {StatusCode::device_error, error.what()};
        }
    } catch (...) {
        return Status(StatusCode::out_of_memory);
    }
}

/// Returns what an action does, or the error that it throws, as catch_to_status().
template <class Action>
auto catch_to_expected(Action&& action) noexcept -> Expected<decltype(action())> {
    std::optional<decltype(action())> value;
    Status status = catch_to_status([&] { value.emplace(action()); });
    if (!status.ok()) {
        return status;
    }
    return std::move(*value);
}

}  // namespace nearfield
