#pragma once

#include "live_contacts.hpp"
#include "scene.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::examples {

/// Red, green, blue, alpha.
using Color = std::array<std::uint8_t, 4>;
inline constexpr Color background_color{24, 26, 34, 255};
inline constexpr std::array<Color, 2> fill_colors{{{52, 86, 139, 255}, {66, 117, 84, 255}}};
inline constexpr std::array<Color, 2> outline_colors{{{132, 176, 240, 255}, {150, 216, 172, 255}}};
inline constexpr Color normal_color{250, 170, 60, 255};
inline constexpr Color outside_color{255, 255, 255, 255};  ///< a contact outside the other shape
inline constexpr Color inside_color{255, 60, 90, 255};     ///< a contact inside it

/// In pixels.
inline constexpr double marker_radius = 2.5;
inline constexpr double normal_length = 16.0;

/// A vertex of a triangle: pixels from the upper left corner of the window.
struct Vertex {
    float x = 0.0F;
    float y = 0.0F;
    Color color{};
};

/// Returns triangles, later ones over earlier ones: fills, outlines, normals, contact points.
[[nodiscard]] std::vector<Vertex> draw(const Scene& scene, const Snapshot& snapshot,
                                       const View& view);

}  // namespace nearfield::examples
