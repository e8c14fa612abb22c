#include <engine/geometry/distance_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::geometry {

namespace {

// Why no gap opens. Let m be the largest move of a snap. A snapped tent or sector still covers
// every point deeper than m inside the true one. Each tent extends 3 m beyond both ends, so it
// covers the first 2 m of the sector beside it; the sector itself covers everything from m on.
//
// The cost. A tent that overlaps the sector by up to 4 m (3 m plus one snap) reports the distance
// to the line where the distance to the end point is right: too small by at most 4 m, at the ridge.
// Elsewhere `distance` is a plane's value, and clamping it at 0 adds at most m.
double overlap(const SubpixelGrid& grid) {
    return 3.0 * grid.largest_move();
}

// Compensates for snapping, which must not pull the far sides in below the requested reach.
double grown_reach(double reach, const SubpixelGrid& grid) {
    return reach + 2.0 * grid.largest_move();
}

// Makes a vertex on the plane through `origin` (at distance 0) with the given gradient. The plane
// is evaluated at the snapped position, so snapping does not tilt it. Depth ranges start at 0.
MeshVertex on_plane(const Vector& position, const Vector& origin, const Vector& gradient,
                    std::uint32_t id, const SubpixelGrid& grid) {
    const Vector snapped(grid.snap(position.x()), grid.snap(position.y()));
    return {.x = static_cast<float>(snapped.x()),
            .y = static_cast<float>(snapped.y()),
            .distance = static_cast<float>(std::max(gradient.dot(snapped - origin), 0.0)),
            .id = id};
}

Vector rotated(const Vector& v, double cosine, double sine) {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
}

Vector left_normal(const Vector& tangent) {
    return {-tangent.y(), tangent.x()};
}

// The largest half angle t of a triangle of the cone. The triangle has its apex at the vertex and
// its far side at distance r, the reach, so its rim points are at r / cos t. On the triangle the
// distance is approximated by k * (the distance along its bisector): at most r * (k - 1) too large,
// at the middle of the far side, and r * (1 / cos t - k) too small, at the rim points. With k
// midway between 1 and 1 / cos t both are half of r * (1 / cos t - 1). That sum must not exceed the
// error less 2 m, which covers the clamping at the apex and samples up to m outside the triangle
// before it was snapped.
double largest_half_angle(double reach, const DistanceMeshOptions& options) {
    const double move = options.grid.largest_move();
    const double range = std::max(options.error, 10.0 * move) - 2.0 * move;
    return 0.5 * std::numbers::pi - arc_sine(reach / (reach + range));
}

// True if the whole box `within` lies beyond the line through `point` with the unit normal
// `normal`, which a snap may move a little. Always false for an infinite box.
bool is_beyond(const DistanceMeshOptions& options, const Vector& point, const Vector& normal) {
    const Box& within = options.within;
    const Vector nearest((normal.x() > 0.0 ? within.min() : within.max()).x(),
                         (normal.y() > 0.0 ? within.min() : within.max()).y());
    return normal.dot(nearest - point) > 2.0 * options.grid.largest_move();
}

// Appends the cone sector over v from direction `from` to direction `to`, `turn` radians
// counter-clockwise.
void append_fan(const Vector& v, const Vector& from, const Vector& to, double turn, double reach,
                std::uint32_t id, const DistanceMeshOptions& options, Mesh& mesh) {
    const double side = turn > 0.0 ? 1.0 : -1.0;
    if (std::abs(turn) < 3.0 && (is_beyond(options, v, -side * left_normal(from)) ||
                                 is_beyond(options, v, side * left_normal(to)))) {
        return;  // most cones near a tile; less than half a turn lies between two lines
    }
    const double angle = 2.0 * largest_half_angle(reach, options);
    const int count = static_cast<int>(std::ceil(std::abs(turn) / angle));
    const double half_angle = turn / (2.0 * count);
    const auto [sine, cosine] = sine_cosine(half_angle);
    const double slope = 0.5 * (1.0 + 1.0 / cosine);
    const double rim = reach / cosine;

    Vector first = from;
    for (int i = 1; i <= count; ++i) {
        const Vector bisector = rotated(first, cosine, sine);
        // The last direction is used as given, so that a full cone closes exactly.
        const Vector last = i < count ? rotated(bisector, cosine, sine) : to;
        const Vector rims[] = {v + rim * first, v + rim * last};
        const bool needed = !is_beyond(options, v, -side * left_normal(first)) &&
                            !is_beyond(options, v, side * left_normal(last)) &&
                            !is_beyond(options, rims[0], bisector);
        first = last;
        if (!needed) {
            continue;
        }
        const Vector gradient = slope * bisector;
        mesh.push_back(on_plane(v, v, gradient, id, options.grid));
        mesh.push_back(on_plane(rims[0], v, gradient, id, options.grid));
        mesh.push_back(on_plane(rims[1], v, gradient, id, options.grid));
    }
}

}  // namespace

void append_tent(const Vector& a, const Vector& b, TentReach reach, std::uint32_t id,
                 const DistanceMeshOptions& options, Mesh& mesh) {
    const Vector tangent = (b - a).stableNormalized();
    if (tangent.isZero(0.0)) {
        return;
    }
    const Vector start = a - overlap(options.grid) * tangent;
    const Vector end = b + overlap(options.grid) * tangent;
    const Vector left = left_normal(tangent);
    for (const bool on_left : {true, false}) {
        const double side_reach = on_left ? reach.left : reach.right;
        if (side_reach <= 0.0) {
            continue;
        }
        const Vector normal = on_left ? left : Vector(-left);
        const Vector far = grown_reach(side_reach, options.grid) * normal;
        const MeshVertex quad[] = {on_plane(start, a, normal, id, options.grid),
                                   on_plane(end, a, normal, id, options.grid),
                                   on_plane(end + far, a, normal, id, options.grid),
                                   on_plane(start + far, a, normal, id, options.grid)};
        mesh.insert(mesh.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
    }
}

void append_cone_sector(const Vector& before, const Vector& v, const Vector& after, double reach,
                        std::uint32_t id, const DistanceMeshOptions& options, Mesh& mesh) {
    const Vector in = (v - before).stableNormalized();
    const Vector out = (after - v).stableNormalized();
    const double grown = grown_reach(reach, options.grid);
    if (in.isZero(0.0) || out.isZero(0.0)) {
        append_fan(v, Vector::UnitX(), Vector::UnitX(), 2.0 * std::numbers::pi, grown, id, options,
                   mesh);
        return;
    }
    // Where the boundary turns left, the tents on its right separate, and vice versa. The normals
    // on that side turn with the boundary, or through the tip where it turns back on itself.
    const double turn = arc_tangent(cross(in, out), in.dot(out));
    const double width_the_tents_cover = overlap(options.grid) - options.grid.largest_move();
    if (grown * std::abs(sine_cosine(0.5 * turn).sine) < width_the_tents_cover) {
        return;
    }
    const double side = turn >= 0.0 ? -1.0 : 1.0;
    append_fan(v, side * left_normal(in), side * left_normal(out), turn, grown, id, options, mesh);
}

}  // namespace nearfield::geometry
