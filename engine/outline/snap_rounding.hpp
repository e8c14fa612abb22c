#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::outline {

/// A cell of the integer grid: the square [x - 1/2, x + 1/2) x [y - 1/2, y + 1/2). Cells are
/// ordered by x, then by y.
struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend bool operator==(const Cell&, const Cell&) = default;
    friend bool operator<(const Cell& a, const Cell& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    }
};

/// 1 if the centre of c lies to the left of the line from a to b, 0 on it, -1 to its right.
/// Coordinates are at most 2^50.
[[nodiscard]] int orientation(const Cell& a, const Cell& b, const Cell& c);

/// The cell that holds a point whose coordinates are at most 2^50.
[[nodiscard]] Cell cell_of(const Vector2& point);

/// True if the closed segment ab has a point in the cell. Exact; coordinates as in exact_kernels.
[[nodiscard]] bool passes(const Vector2& a, const Vector2& b, const Cell& cell);

/// A directed edge between the centres of two cells, which replaces part of an edge of a ring.
struct SnappedEdge {
    std::uint32_t from = 0;  ///< index into SnapRounding::cells
    std::uint32_t to = 0;    ///< likewise
    std::uint32_t ring = 0;  ///< whose edge it comes from
};

/// Rings whose vertices and crossings have moved to the centres of cells. Any two edges share an
/// end, coincide, or have no point in common; no edge passes a cell's centre.
struct SnapRounding {
    std::vector<Cell> cells;  ///< those that hold a vertex or a crossing, sorted
    std::vector<SnappedEdge> edges;
};

/// Snap rounding (Hobby, Practical Segment Intersection with Finite Precision Output, Computational
/// Geometry 13(4), 1999): a cell that holds a vertex or a crossing is hot, and each edge becomes
/// the chain of the centres of the hot cells that it passes. Which cells an edge passes is decided
/// exactly. Each point moves by at most half a cell in x and in y, and edges never pass each
/// other or a hot cell on the way, so a region can collapse but neither open nor turn over.
///
/// Coordinates as in exact_kernels, and at most 2^50. Throws StatusException with too_large if more
/// than `most` cells would be hot.
[[nodiscard]] SnapRounding snap_round(std::span<const Ring> rings, std::size_t most);

}  // namespace nearfield::outline
