#pragma once

#include <tools/rendering/drawing.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::tools {

/// Vertices and indices that grow primitive by primitive.
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
    /// A sector of a disc that starts at the angle `from` and extends over the angle `over`.
    void sector(Vector2 center, double radius, double from, double over, const Color& color);

    std::vector<MeshVertex>& vertices_;
    std::vector<std::uint32_t>& indices_;
};

}  // namespace nearfield::tools
