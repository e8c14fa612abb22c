#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <array>
#include <cstdint>

namespace nearfield::geometry {

/// Row-crossing quads: the polygon fill of a tile by parity. A sample is inside where the ray from
/// it towards +x crosses an odd number of edges, so each edge inverts the samples to its left: the
/// quad between the edge and the tile's left border. Adjacent quads meet on one horizontal line,
/// which the fill rule gives to one of them, so parity comes out right for any number of edges, in
/// any order, folded or not. Triangles come in either winding: draw them without culling.
class FillMesh {
public:
    /// A tile of width x height cells.
    FillMesh(std::uint32_t width, std::uint32_t height, SubpixelGrid grid);

    /// Appends the quad (two triangles, one where an end lies on the left border, or none where the
    /// edge crosses no row of the tile or lies left of it) of the edge ab, in cells of the tile.
    /// Both ends are snapped. Parts right of the tile are moved to a border right of it and parts
    /// left of it are dropped, which no sample can tell; everything stays within one cell of the
    /// tile, so no rasteriser has to clip. Where an edge must be cut for that, the cut lies outside
    /// the tile and is snapped too: the line moves by no more than largest_move().
    ///
    /// Edges that share an end point must be given that very same end point: the shared point is
    /// snapped alike, whatever the edge. An edge and its reverse cancel exactly.
    void append(const Vector& a, const Vector& b, Mesh& mesh) const;

    /// A part of an edge between two of the tile's borders, snapped; it goes up.
    struct Piece {
        Vector from;
        Vector to;
    };
    /// What an edge becomes: at most three pieces. Those that invert no sample are left out.
    struct Pieces {
        std::array<Piece, 3> list;
        std::uint32_t count = 0;
    };
    /// The right sides of the quads that append() makes.
    [[nodiscard]] Pieces pieces(const Vector& a, const Vector& b) const;

private:
    void add_piece(const Vector& from, const Vector& to, Pieces& pieces) const;

    double width_;
    double height_;
    SubpixelGrid grid_;
};

}  // namespace nearfield::geometry
