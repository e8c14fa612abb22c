#pragma once

#include <nearfield/context.hpp>

#include <tools/drawing/view.hpp>
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

/// Parses the option --response. Throws InputError.
[[nodiscard]] simulation::Response parse_response(const std::string& name);

/// The view of a scene on a page of this width in pixels; the height follows.
[[nodiscard]] View view_of(const simulation::Scene& scene, double page_width);

}  // namespace nearfield::tools
