#pragma once

#include <nearfield/shape.hpp>

#include <tools/render/drawing.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::tools {

/// A corner of a triangle.
struct MeshVertex {
    float x = 0.0F;  ///< pixels from the upper left corner of the page
    float y = 0.0F;
    /// A place in the painter's picture of letters, 0 to 1; outside that, as here, there is plain
    /// colour.
    float u = -1.0F;
    float v = -1.0F;
    std::uint32_t color = 0;  ///< red in the lowest byte, then green, blue, alpha
};

/// Triangles of a mesh that are cut off at a rectangle of whole pixels.
struct MeshPart {
    std::int32_t left = 0;
    std::int32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t first = 0;  ///< of the indices
    std::uint32_t count = 0;
};

/// Triangles for a GPU, the later ones over the earlier ones.
class Mesh {
public:
    /// Of a page of that size; without a triangle.
    Mesh(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

    /// Adds a drawing. Fills follow the odd-even rule whatever their rings do. A translucent line
    /// of more than one piece is denser at its joints.
    void add(const Drawing& drawing);
    /// Adds triangles that come as such. `first` of the parts counts from the first of `indices`,
    /// these count from the first of `vertices`.
    void add(std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
             std::span<const MeshPart> parts);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] const std::vector<MeshVertex>& vertices() const { return vertices_; }
    [[nodiscard]] const std::vector<std::uint32_t>& indices() const { return indices_; }
    [[nodiscard]] const std::vector<MeshPart>& parts() const { return parts_; }

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<MeshVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<MeshPart> parts_;
};

}  // namespace nearfield::tools
