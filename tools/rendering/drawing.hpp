#pragma once

#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::tools {

/// The interior of rings by the odd-even rule, in one colour.
struct FilledRings {
    std::vector<Ring> rings;
    Color color;
};

/// A line of a given width with round corners and ends.
struct DrawnLine {
    std::vector<Vector2> points;
    bool closed = false;
    Color color;
    double width = 1.0;
};

struct DrawnDot {
    Vector2 center;
    double radius = 1.0;
    Color color;
};

/// A grid of colours over a rectangle, row by row from its `min`.
struct ColoredCells {
    Rectangle rectangle;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<Color> colors;
};

using DrawnItem = std::variant<FilledRings, DrawnLine, DrawnDot, ColoredCells>;

/// A list of coloured primitives in pixels of a page (x to the right, y down); later ones cover
/// earlier ones. Independent of the renderer.
class Drawing {
public:
    void fill(std::vector<Ring> rings, const Color& color);
    void line(std::vector<Vector2> points, const Color& color, double width, bool closed = false);
    void dot(Vector2 center, double radius, const Color& color);
    /// Adds a shaft and, if it is long enough, a filled head at `to`.
    void arrow(Vector2 from, Vector2 to, double head, const Color& color, double width);
    void cells(ColoredCells cells);
    /// Adds a line of text; its baseline starts, is centred or ends at `position`.
    void text(Vector2 position, const std::string& text, double size, const Color& color,
              Align align = Align::left);

    void clear() { items_.clear(); }
    [[nodiscard]] const std::vector<DrawnItem>& items() const { return items_; }

private:
    std::vector<DrawnItem> items_;
};

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
