#pragma once

#include "examples/common/picture.hpp"
#include "picture_file.hpp"

#include <string>

namespace nearfield::test {

/// The scene after the mouse has dragged the star.
[[nodiscard]] examples::Scene dragged_scene(const Vector2& by);

/// Its contacts according to the CPU.
[[nodiscard]] std::vector<ContactPoint> contacts_by_cpu(const examples::Scene& scene);

/// The comparison of a picture with a scene and its contacts.
struct Comparison {
    std::string difference;  ///< the first difference and their number; empty: none
    int inside_markers = 0;  ///< pixels in the colour of contacts inside the other shape
    int outside_markers = 0;
    int normals = 0;              ///< normals whose middle is visible
    std::array<int, 2> filled{};  ///< pixels in the colour of each shape's interior
    int background = 0;
    int lines = 0;  ///< pixels in the colour of outlines or normals
};

/// Exactly the pixels that a contact's marker covers have the marker's colour; the middle of each
/// normal has the colour of normals; every other pixel shows a shape's interior if its centre is in
/// one, or background, or an outline or a normal. The rectangle from `label` to the lower left (an
/// item of Qt Quick) is not compared.
[[nodiscard]] Comparison compare(const Pixels& picture, const examples::Scene& scene,
                                 const std::vector<ContactPoint>& contacts, const Vector2& label);

}  // namespace nearfield::test
