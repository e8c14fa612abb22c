#pragma once

#include <nearfield/context.hpp>

#include <tools/dynamics/world.hpp>
#include <tools/picture/view.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// A scene by its name, with a tolerance of its own where one is given (the text of -d), and of
/// pour with so many stars. Throws InputError.
[[nodiscard]] dynamics::Scene make_scene(const std::string& name,
                                         const std::optional<std::string>& tolerance,
                                         std::optional<std::uint32_t> bodies = std::nullopt);

/// Reads the option --response. Throws InputError.
[[nodiscard]] dynamics::Response parse_response(const std::string& name);

/// What pictures of a scene show, on a page so many pixels wide and as high as that takes.
[[nodiscard]] View view_of(const dynamics::Scene& scene, double page_width);

}  // namespace nearfield::tools
