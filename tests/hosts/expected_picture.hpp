#pragma once

#include "examples/common/picture.hpp"
#include "picture_file.hpp"

#include <string>

namespace nearfield::test {

/// The scene after the mouse has dragged the star.
[[nodiscard]] examples::Scene dragged_scene(const Vector2& by);

/// Its contacts as the CPU answers them.
[[nodiscard]] std::vector<ContactRecord> contacts_by_cpu(const examples::Scene& scene);

/// How a picture compares with a scene and its contacts.
struct Comparison {
    std::string difference;  ///< the first one, and how many there are; empty: none
    int inside_markers = 0;  ///< pixels in the colour of contacts inside the other shape
    int outside_markers = 0;
    int normals = 0;              ///< whose middle is to be seen
    std::array<int, 2> filled{};  ///< pixels in the colour of each shape's inside
    int background = 0;
    int lines = 0;  ///< pixels in the colour of outlines or normals
};

/// Every pixel that a contact's marker covers has the marker's colour, and no other has it; the
/// middle of each normal has the colour of normals; everything else is a shape's inside, where a
/// pixel's centre lies in one, or background, or an outline or a normal. What lies in the rectangle
/// from `label` to the lower edge at the left (an item of Qt Quick) is left out.
[[nodiscard]] Comparison compare(const Pixels& picture, const examples::Scene& scene,
                                 const std::vector<ContactRecord>& contacts, const Vector2& label);

}  // namespace nearfield::test
