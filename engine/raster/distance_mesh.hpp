#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/raster/distance_mesh_kernels.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::raster {

struct DistanceMeshOptions {
    /// The most by which the feature that wins at a sample may be farther away than the nearest
    /// one, in cells. `distance` itself is off by at most half of this in either direction. Values
    /// below 10 * grid.largest_move(), the cost of snapping alone, are raised to that.
    double error = 0.125;
    SubpixelGrid grid = {};
    /// Triangles wholly outside this box are omitted: a cone seen from afar contributes only a few.
    Box within = {Vector::Constant(-0x1p24), Vector::Constant(0x1p24)};
};

/// Extent of a tent on either side of the direction from a to b, in cells; 0: no tent on that side.
struct TentReach {
    double left = 0.0;
    double right = 0.0;
};

/// The unit vector from a to b; zero if they coincide.
[[nodiscard]] inline Vector tangent(const Vector& a, const Vector& b) {
    return (b - a).stableNormalized();
}

/// The distance mesh of a polygon's boundary (section 2.2.2 of the paper and its reference [10]).
/// Each edge has a tent: two quads, exact because the distance to a line is linear. Each vertex has
/// the sector of a cone between the tents of its two edges, as flat triangles with a bounded error.
/// Drawn with depth test LESS, the nearest feature wins at every sample.
///
/// Vertices are snapped and carry the distance at their snapped position. No `distance` exceeds
/// reach + error. Nothing is clipped: if an edge leaves the neighbourhood of the tile, pass
/// add_tent the part within `reach` plus one cell of the tile (see clip.hpp), and omit the vertices
/// outside it; beyond 2^24 / grid.steps cells `float` cannot represent the grid.
///
/// Features are added first; place() then computes all vertices together, with SIMD.
class DistanceMesh {
public:
    /// Drops the features of the tile before. Keeps the memory.
    void begin(const DistanceMeshOptions& options);

    /// Adds the tent over edge ab with feature `id`: two triangles on each side it extends to. To
    /// leave no gap between neighbours after snapping, a tent extends three largest moves beyond
    /// both ends; that is part of `error`. `along`: tangent(a, b); a zero-length edge adds nothing.
    void add_tent(const Vector& a, const Vector& b, const Vector& along, TentReach reach,
                  std::uint32_t id);

    /// Adds the sector of the cone over vertex v between the tents of the edges that arrive with
    /// tangent `in` and leave with tangent `out`, out to distance `reach`: the points nearer to v
    /// than to any other point of the two edges. Adds nothing where the two tents, which overlap
    /// the sector slightly, cover it. Next to a zero-length edge, whose tangent is zero, the sector
    /// is the full cone. Where the boundary turns back on itself it is the half cone beyond the
    /// tip.
    void add_cone_sector(const Vector& in, const Vector& v, const Vector& out, double reach,
                         std::uint32_t id);

    /// Computes the vertices; returns the largest distance of any, in cells.
    [[nodiscard]] float place();

    /// Upper bound on the number of triangles.
    [[nodiscard]] std::size_t max_triangles() const {
        return kernels::piece_triangles * ids_.size();
    }
    /// Calls `use(triangle)`, an array of three MeshVertex, for every triangle that reaches into
    /// the box. Precondition: place() was called after the last feature was added.
    template <class Use>
    void for_each_triangle(Use&& use) const;

private:
    void add_fan(const Vector& v, const Vector& from, const Vector& to, double turn, double reach,
                 std::uint32_t id);
    void add_piece(const Vector& origin, const Vector& gradient,
                   const std::array<Vector, kernels::piece_corners>& corners, std::uint32_t id);
    [[nodiscard]] double largest_angle(double reach);
    [[nodiscard]] bool is_beyond(const Vector& point, const Vector& normal) const;

    DistanceMeshOptions options_;
    double move_ = 0.0;               // the largest of a snap
    double reach_ = 0.0;              // of the cone before
    double angle_ = 0.0;              // the largest of a triangle there
    std::vector<std::uint32_t> ids_;  // by piece
    std::vector<kernels::Pieces> pieces_;
    std::vector<kernels::PlacedPieces> placed_;
};

template <class Use>
void DistanceMesh::for_each_triangle(Use&& use) const {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        const kernels::PlacedPieces& piece = placed_[i / kernels::pieces_at_once];
        const std::size_t lane = i % kernels::pieces_at_once;
        const auto corner = [&](std::size_t c) {
            return MeshVertex{piece.x[c][lane], piece.y[c][lane], piece.distance[c][lane], ids_[i]};
        };
        for (std::size_t t = 0; t < kernels::piece_triangles; ++t) {
            if (piece.needed[t][lane] != 0.0F) {
                use(std::array<MeshVertex, 3>{corner(0), corner(t + 1), corner(t + 2)});
            }
        }
    }
}

}  // namespace nearfield::raster
