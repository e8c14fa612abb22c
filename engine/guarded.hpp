#pragma once

#include <engine/failure.hpp>
#include <nearfield/status.hpp>

#include <exception>
#include <new>

namespace nearfield {

/// Turns whatever an action throws into a status: no exception crosses the interface. Where there
/// is no memory even for the words, the status has none.
template <class Action>
Status guarded(Action&& action) noexcept {
    try {
        try {
            action();
            return {};
        } catch (const Failure& failure) {
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
