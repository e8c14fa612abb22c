#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// The distance mesh of a polygon's boundary (section 2.2.2 of the paper and its reference [10]):
/// over each edge a tent (two quads, exact since distance to a line is linear), over each vertex
/// the sector of a cone between the tents of its two edges, as flat triangles with a bounded error.
/// Drawn with the depth test LESS, the nearest feature wins at every sample.
///
/// Vertices are snapped, and carry the distance at the place they were snapped to. No `distance`
/// exceeds reach + error. Nothing is clipped: of an edge that leaves the neighbourhood of the tile,
/// hand append_tent the part within `reach` of the tile and a cell more (see clip.hpp), and leave
/// out the vertices outside it; beyond 2^24 / grid.steps cells `float` no longer holds the grid.
struct DistanceMeshOptions {
    /// How much farther than the nearest feature the one that wins at a sample can be, in cells.
    /// `distance` itself is off by at most half of this, up or down. Less than
    /// 10 * grid.largest_move() is taken for that: what snapping alone costs.
    double error = 0.125;
    SubpixelGrid grid = {};
    /// Triangles of cones wholly outside this box may be left out: of a cone seen from afar only a
    /// few matter.
    Box within = {Vector::Constant(-std::numeric_limits<double>::infinity()),
                  Vector::Constant(std::numeric_limits<double>::infinity())};
};

/// How far a tent reaches on either side of the way from a to b, in cells; 0: not at all.
struct TentReach {
    double left = 0.0;
    double right = 0.0;
};

/// Appends the tent over edge ab: two triangles on each side that it reaches out to, with `id`. To
/// leave no crack between neighbours after snapping, a tent reaches three
/// largest moves beyond both ends; that is part of `error`. An edge of no length appends nothing.
void append_tent(const Vector& a, const Vector& b, TentReach reach, std::uint32_t id,
                 const DistanceMeshOptions& options, Mesh& mesh);

/// Appends the sector of the cone over vertex v between the tents of the edges from `before` to v
/// and from v to `after`, out to distance `reach`: the points nearer to v than to any other point
/// of the two edges. Nothing where the two tents, which overlap the sector a little, cover it.
/// Coinciding points are allowed: where an edge has no length the sector is the full cone. Where
/// the boundary turns back on itself it is the half cone beyond the tip.
void append_cone_sector(const Vector& before, const Vector& v, const Vector& after, double reach,
                        std::uint32_t id, const DistanceMeshOptions& options, Mesh& mesh);

}  // namespace nearfield::geometry
