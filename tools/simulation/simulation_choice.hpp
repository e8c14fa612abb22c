#pragma once

#include <nearfield/context.hpp>

#include <tools/drawing/view.hpp>
#include <tools/io/names.hpp>
#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/world.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// Makes a scene by name, with its own tolerance replaced if one is given (the text of -d). The
/// number of stars applies to pour. Throws InputError.
[[nodiscard]] simulation::Scene make_scene(const std::string& name,
                                           const std::optional<std::string>& tolerance,
                                           std::optional<std::uint32_t> bodies = std::nullopt);

/// The scene of clearances with this name; null if it is another scene's.
[[nodiscard]] const simulation::NamedClearanceScene* find_clearance_scene(const std::string& name);

template <>
inline constexpr auto names<simulation::Response> =
    std::to_array<NamedValue<simulation::Response>>({
        {"penalty", simulation::Response::penalty},
        {"backtracking", simulation::Response::backtracking},
    });

/// The view of a part of the world on a page of this width in pixels; the height follows.
[[nodiscard]] View view_of(const Rectangle& world, double page_width);

}  // namespace nearfield::tools
