#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <array>
#include <span>

namespace nearfield::geometry {

/// Row-crossing quads: fills a polygon in a tile by parity. A sample is inside where the ray from
/// it towards +x crosses an odd number of edges, so each edge inverts the samples to its left: the
/// quad between the edge and the tile's left border. Adjacent quads meet on a horizontal line,
/// which the fill rule assigns to one of them, so the parity is correct for any number of edges in
/// any order, folded or not. Triangles have either winding: draw them without culling.
class FillMesh {
public:
    /// `width` and `height`: the tile's size in cells.
    FillMesh(std::uint32_t width, std::uint32_t height, SubpixelGrid grid);

    /// Appends the quad of the edge ab, given in cells of the tile: two triangles, one if an end
    /// lies on the left border, none if the edge crosses no row of the tile or lies to its left.
    /// Both ends are snapped. Parts right of the tile move to a border right of it and parts left
    /// of it are dropped, neither of which changes any sample; everything stays within one cell of
    /// the tile, so no rasteriser has to clip. Where this cuts an edge, the cut point lies outside
    /// the tile and is snapped too: the line moves by no more than largest_move().
    ///
    /// Edges that share an end point must pass exactly the same point, so that it snaps identically
    /// for both. An edge and its reverse cancel exactly.
    void append(const Vector& a, const Vector& b, Mesh& mesh) const;

    /// A straight piece of an edge with both ends snapped. It inverts every sample to its left in
    /// the rows whose centres it spans (lower end included, upper end excluded).
    struct Piece {
        double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
    };
    /// The parts of an edge that invert samples of the tile.
    struct Pieces {
        std::array<Piece, 3> pieces;
        std::size_t count = 0;
        [[nodiscard]] auto begin() const { return pieces.begin(); }
        [[nodiscard]] auto end() const {
            return pieces.begin() + static_cast<std::ptrdiff_t>(count);
        }
    };
    [[nodiscard]] Pieces pieces(const Vector& a, const Vector& b) const;

private:
    void add_piece(const Vector& from, const Vector& to, Pieces& pieces) const;

    double width_;
    double height_;
    SubpixelGrid grid_;
};

}  // namespace nearfield::geometry
