#include <engine/raster/distance_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::raster {

namespace {

// Why no gap opens. Let m be the largest move of a snap. A snapped tent or sector still covers
// every point deeper than m inside the true one. Each tent extends 3 m beyond both ends, so it
// covers the first 2 m of the sector beside it; the sector itself covers everything from m on.
//
// The cost. A tent that overlaps the sector by up to 4 m (3 m plus one snap) reports the distance
// to the line where the distance to the end point is right: too small by at most 4 m, at the ridge.
// Elsewhere `distance` is a plane's value, and clamping it at 0 adds at most m.
double overlap(double move) {
    return 3.0 * move;
}

// Compensates for snapping, which must not pull the far sides in below the requested reach.
double grown_reach(double reach, double move) {
    return reach + 2.0 * move;
}

// The cosine of an angle of turn up to which it is surely less than half a turn.
constexpr double almost_half_a_turn = -0.99;

Vector rotated(const Vector& v, double cosine, double sine) {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
}

Vector left_normal(const Vector& tangent) {
    return {-tangent.y(), tangent.x()};
}

}  // namespace

void DistanceMesh::begin(const DistanceMeshOptions& options) {
    options_ = options;
    move_ = options.grid.largest_move();
    reach_ = angle_ = 0.0;
    ids_.clear();
}

// The largest half angle t of a triangle of the cone. The triangle has its apex at the vertex and
// its far side at distance r, the reach, so its rim points are at r / cos t. On the triangle the
// distance is approximated by k * (the distance along its bisector): at most r * (k - 1) too large,
// at the middle of the far side, and r * (1 / cos t - k) too small, at the rim points. With k
// midway between 1 and 1 / cos t both are half of r * (1 / cos t - 1). That sum must not exceed the
// error less 2 m, which covers the clamping at the apex and samples up to m outside the triangle
// before it was snapped.
double DistanceMesh::largest_angle(double reach) {
    if (reach != reach_) {  // consecutive vertices mostly have the same
        const double range = std::max(options_.error, 10.0 * move_) - 2.0 * move_;
        reach_ = reach;
        angle_ = 2.0 * (0.5 * std::numbers::pi - geometry::arc_sine(reach / (reach + range)));
    }
    return angle_;
}

/// True if the whole box lies beyond the line through `point` with the unit normal `normal`, which
/// a snap may move a little.
bool DistanceMesh::is_beyond(const Vector& point, const Vector& normal) const {
    const Box& within = options_.within;
    const Vector nearest((normal.x() > 0.0 ? within.min() : within.max()).x(),
                         (normal.y() > 0.0 ? within.min() : within.max()).y());
    return normal.dot(nearest - point) > 2.0 * move_;
}

void DistanceMesh::add_piece(const Vector& origin, const Vector& gradient,
                             const std::array<Vector, kernels::piece_corners>& corners,
                             std::uint32_t id) {
    const std::size_t lane = ids_.size() % kernels::pieces_at_once;
    const std::size_t block = ids_.size() / kernels::pieces_at_once;
    if (block == pieces_.size()) {
        pieces_.emplace_back();
    }
    ids_.push_back(id);
    kernels::Pieces& pieces = pieces_[block];
    pieces.origin_x[lane] = origin.x();
    pieces.origin_y[lane] = origin.y();
    pieces.gradient_x[lane] = gradient.x();
    pieces.gradient_y[lane] = gradient.y();
    for (std::size_t c = 0; c < kernels::piece_corners; ++c) {
        pieces.x[c][lane] = corners[c].x();
        pieces.y[c][lane] = corners[c].y();
    }
}

void DistanceMesh::add_tent(const Vector& a, const Vector& b, const Vector& along, TentReach reach,
                            std::uint32_t id) {
    if (along.isZero(0.0)) {
        return;
    }
    const Vector start = a - overlap(move_) * along;
    const Vector end = b + overlap(move_) * along;
    const Vector left = left_normal(along);
    for (const bool on_left : {true, false}) {
        const double side_reach = on_left ? reach.left : reach.right;
        if (side_reach > 0.0) {
            const Vector normal = on_left ? left : Vector(-left);
            const Vector far = grown_reach(side_reach, move_) * normal;
            add_piece(a, normal, {start, end, end + far, start + far}, id);
        }
    }
}

/// Adds the cone sector over v from direction `from` to direction `to`, `turn` radians
/// counter-clockwise.
void DistanceMesh::add_fan(const Vector& v, const Vector& from, const Vector& to, double turn,
                           double reach, std::uint32_t id) {
    const int count = static_cast<int>(std::ceil(std::abs(turn) / largest_angle(reach)));
    const auto [sine, cosine] = sine_cosine(turn / (2.0 * count));
    const double slope = 0.5 * (1.0 + 1.0 / cosine);
    const double rim = reach / cosine;

    Vector first = from;
    Vector first_rim = v + rim * first;
    for (int i = 1; i <= count; ++i) {
        const Vector bisector = rotated(first, cosine, sine);
        // The last direction is used as given, so that a full cone closes exactly.
        const Vector last = i < count ? rotated(bisector, cosine, sine) : to;
        const Vector last_rim = v + rim * last;
        add_piece(v, slope * bisector, {v, first_rim, last_rim, last_rim}, id);
        first = last;
        first_rim = last_rim;
    }
}

void DistanceMesh::add_cone_sector(const Vector& in, const Vector& v, const Vector& out,
                                   double reach, std::uint32_t id) {
    const double grown = grown_reach(reach, move_);
    if (in.isZero(0.0) || out.isZero(0.0)) {
        add_fan(v, Vector::UnitX(), Vector::UnitX(), 2.0 * std::numbers::pi, grown, id);
        return;
    }
    // The chord of the turn is twice the sine of half of it.
    const double width_the_tents_cover = overlap(move_) - move_;
    const double chord = 2.0 * width_the_tents_cover / grown;
    if ((out - in).squaredNorm() < chord * chord) {
        return;
    }
    // Where the boundary turns left, the tents on its right separate, and vice versa. The normals
    // on that side turn with the boundary, or through the tip where it turns back on itself.
    // Where it turns straight back the sine may be -0.0, whose angle is that of a right turn.
    const double sine = geometry::cross(in, out) + 0.0;
    const double cosine = in.dot(out);
    const double side = sine >= 0.0 ? -1.0 : 1.0;
    const Vector from = side * left_normal(in);
    const Vector to = side * left_normal(out);
    if (cosine > almost_half_a_turn &&
        (is_beyond(v, side * left_normal(from)) || is_beyond(v, -side * left_normal(to)))) {
        return;  // most cones near a tile; less than half a turn lies between two lines
    }
    add_fan(v, from, to, arc_tangent(sine, cosine), grown, id);
}

float DistanceMesh::place() {
    placed_.resize(pieces_.size());
    return kernels::place_pieces(pieces_.data(), ids_.size(), options_.grid, options_.within,
                                 placed_.data());
}

}  // namespace nearfield::raster
