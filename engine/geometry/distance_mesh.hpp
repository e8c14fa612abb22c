#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// The distance mesh of a polygon's boundary (section 2.2.2 of the paper and its reference [10]).
/// Each edge has a tent: two quads, exact because the distance to a line is linear. Each vertex has
/// the sector of a cone between the tents of its two edges, as flat triangles with a bounded error.
/// Drawn with depth test LESS, the nearest feature wins at every sample.
///
/// Vertices are snapped and carry the distance at their snapped position. No `distance` exceeds
/// reach + error. Nothing is clipped: if an edge leaves the neighbourhood of the tile, pass
/// append_tent the part within `reach` plus one cell of the tile (see clip.hpp), and omit the
/// vertices outside it; beyond 2^24 / grid.steps cells `float` cannot represent the grid.
struct DistanceMeshOptions {
    /// The most by which the feature that wins at a sample may be farther away than the nearest
    /// one, in cells. `distance` itself is off by at most half of this in either direction. Values
    /// below 10 * grid.largest_move(), the cost of snapping alone, are raised to that.
    double error = 0.125;
    SubpixelGrid grid = {};
    /// Cone triangles wholly outside this box may be omitted: a cone seen from afar contributes
    /// only a few.
    Box within = {Vector::Constant(-std::numeric_limits<double>::infinity()),
                  Vector::Constant(std::numeric_limits<double>::infinity())};
};

/// Extent of a tent on either side of the direction from a to b, in cells; 0: no tent on that side.
struct TentReach {
    double left = 0.0;
    double right = 0.0;
};

/// Appends the tent over edge ab with feature `id`: two triangles on each side it extends to. To
/// leave no gap between neighbours after snapping, a tent extends three largest moves beyond both
/// ends; that is part of `error`. A zero-length edge appends nothing.
void append_tent(const Vector& a, const Vector& b, TentReach reach, std::uint32_t id,
                 const DistanceMeshOptions& options, Mesh& mesh);

/// Appends the sector of the cone over vertex v between the tents of the edges from `before` to v
/// and from v to `after`, out to distance `reach`: the points nearer to v than to any other point
/// of the two edges. Appends nothing where the two tents, which overlap the sector slightly, cover
/// it. Coincident points are allowed: next to a zero-length edge the sector is the full cone. Where
/// the boundary turns back on itself it is the half cone beyond the tip.
void append_cone_sector(const Vector& before, const Vector& v, const Vector& after, double reach,
                        std::uint32_t id, const DistanceMeshOptions& options, Mesh& mesh);

}  // namespace nearfield::geometry
