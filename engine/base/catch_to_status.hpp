#pragma once

#include <engine/base/status_exception.hpp>
#include <nearfield/status.hpp>

#include <exception>
#include <new>

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

}  // namespace nearfield
