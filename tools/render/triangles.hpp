#pragma once

#include <tools/render/drawing.hpp>
#include <tools/render/mesh.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::tools {

/// Corners and indices that grow item by item.
class Triangles {
public:
    Triangles(std::vector<MeshVertex>& vertices, std::vector<std::uint32_t>& indices)
        : vertices_(vertices), indices_(indices) {}

    void add(const FilledRings& item);
    void add(const DrawnLine& item);
    void add(const DrawnDot& item);
    void add(const ColoredCells& item);

private:
    /// A convex polygon.
    void polygon(const std::vector<Vector2>& corners, const Color& color);
    /// A part of a disc: from one angle on, over some angle.
    void sector(Vector2 center, double radius, double from, double over, const Color& color);

    std::vector<MeshVertex>& vertices_;
    std::vector<std::uint32_t>& indices_;
};

}  // namespace nearfield::tools
