#include <engine/geometry/segment.hpp>
#include <engine/mtv/convex_piece.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace nearfield::mtv {

using geometry::Vector;

// At least as much as most pieces ever need: memory moves from piece to piece, and none of it
// should grow again later.
constexpr std::size_t usual_corners = 64;

ConvexPiece::ConvexPiece() {
    for (Corners* const corners : {&corners_, &core_, &kept_}) {
        corners->reserve(usual_corners);
    }
}

void ConvexPiece::begin(const Vector& centre, const Vector& half, double margin) {
    const auto set = [&centre](Corners& corners, double x, double y) {
        corners.assign({centre + Vector(-x, -y), centre + Vector(x, -y), centre + Vector(x, y),
                        centre + Vector(-x, y)});
    };
    margin_ = margin;
    set(corners_, half.x(), half.y());
    core_.clear();
    if (half.minCoeff() > margin) {
        set(core_, half.x() - margin, half.y() - margin);
    }
}

void ConvexPiece::clip(const Corners& corners, const Vector& direction, double least,
                       Corners& kept) {
    kept.clear();
    if (corners.empty()) {
        return;
    }
    if (kept.capacity() <= corners.size()) {
        kept.reserve(2 * corners.size());
    }
    const Vector* from = &corners.back();
    double beyond = direction.dot(*from) - least;
    for (const Vector& to : corners) {
        const double beyond_to = direction.dot(to) - least;
        if ((beyond > 0.0) != (beyond_to > 0.0)) {
            kept.push_back(*from + beyond / (beyond - beyond_to) * (to - *from));
        }
        if (beyond_to > 0.0) {
            kept.push_back(to);
        }
        from = &to;
        beyond = beyond_to;
    }
}

void ConvexPiece::keep(const Vector& direction, double least) {
    clip(corners_, direction, least, kept_);
    corners_.swap(kept_);
    clip(core_, direction, least + margin_, kept_);
    core_.swap(kept_);
}

void ConvexPiece::keep_of(const ConvexPiece& whole, const Vector& direction, double least) {
    margin_ = whole.margin_;
    clip(whole.core_, direction, least + margin_, core_);
    if (!core_.empty()) {
        clip(whole.corners_, direction, least, corners_);
    }
}

Vector ConvexPiece::nearest_of(const Corners& corners) {
    Vector nearest = Vector::Zero();
    double squared = std::numeric_limits<double>::infinity();
    bool holds_zero = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector& from = corners[i];
        const Vector& to = corners[i + 1 < corners.size() ? i + 1 : 0];
        holds_zero = holds_zero && geometry::cross(from, to) >= 0.0;
        const Vector point = geometry::nearest_on_segment(Vector::Zero(), from, to).point;
        if (point.squaredNorm() < squared) {
            squared = point.squaredNorm();
            nearest = point;
        }
    }
    return holds_zero ? Vector(Vector::Zero()) : nearest;
}

Vector ConvexPiece::middle() const {
    Vector sum = Vector::Zero();
    for (const Vector& corner : core_) {
        sum += corner;
    }
    return sum / static_cast<double>(core_.size());
}

ConvexPiece::Range ConvexPiece::along(const Vector& direction) const {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Vector& corner : corners_) {
        const double at = direction.dot(corner);
        range = {std::min(range.least, at), std::max(range.most, at)};
    }
    return range;
}

geometry::Box ConvexPiece::box() const {
    geometry::Box box;
    for (const Vector& corner : corners_) {
        box.extend(corner);
    }
    return box;
}

}  // namespace nearfield::mtv
