#pragma once

#include <engine/base/catch_to_status.hpp>
#include <engine/base/interruption.hpp>
#include <nearfield/limits.hpp>

#include <limits>
#include <optional>

namespace nearfield {

/// Whether a call with these limits may end early, or report how far it is.
[[nodiscard]] inline bool limits_anything(const Limits& limits) {
    return limits.cancel != nullptr || limits.progress != nullptr ||
           limits.seconds != std::numeric_limits<double>::infinity();
}

/// Calls `action`, which returns a Status or an Expected, within the limits of a call; returns the
/// same, or the error of limits that cannot be used.
template <class Action>
auto call_within(const Limits& limits, const Action& action) -> decltype(action()) {
    if (!limits_anything(limits)) {
        const InterruptionScope scope(nullptr);
        return action();
    }
    std::optional<Interruption> interruption;
    if (Status status = catch_to_status([&] { interruption.emplace(limits); }); !status.ok()) {
        return status;
    }
    const InterruptionScope scope(&*interruption);
    return action();
}

/// As call_within(), for an action that throws, as catch_to_status().
template <class Action>
Status catch_within(const Limits& limits, const Action& action) {
    return call_within(limits, [&] { return catch_to_status(action); });
}

}  // namespace nearfield
