#pragma once

#include <nearfield/shape.hpp>

#include <tools/rendering/drawing.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::tools {

/// A vertex of a triangle.
struct MeshVertex {
    float x = 0.0F;  ///< pixels from the upper left corner of the page
    float y = 0.0F;
    /// A position in the painter's glyph image, 0 to 1; outside, as by default, the colour is
    /// plain.
    float u = -1.0F;
    float v = -1.0F;
    std::uint32_t color = 0;  ///< red in the lowest byte, then green, blue, alpha
};

/// Triangles of a mesh that are clipped to a rectangle of whole pixels.
struct MeshPart {
    std::int32_t left = 0;
    std::int32_t top = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t first = 0;  ///< index of its first index
    std::uint32_t count = 0;
};

/// Triangles for a GPU; later ones cover earlier ones.
class Mesh {
public:
    /// An empty mesh for a page of that size.
    Mesh(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

    /// Adds a drawing. Fills follow the odd-even rule for any rings. A translucent line of several
    /// segments is denser at its joints.
    void add(const Drawing& drawing);
    /// Adds ready-made triangles. `first` of the parts is relative to `indices`, which are relative
    /// to `vertices`.
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
