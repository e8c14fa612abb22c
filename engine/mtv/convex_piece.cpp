#include <engine/geometry/segment.hpp>
#include <engine/mtv/convex_piece.hpp>

#include <limits>

namespace nearfield::mtv {

using geometry::Vector;

void ConvexPiece::begin(const Vector& centre, double half) {
    corners_.assign({centre + Vector(-half, -half), centre + Vector(half, -half),
                     centre + Vector(half, half), centre + Vector(-half, half)});
}

void ConvexPiece::keep(const Vector& direction, double least) {
    kept_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Vector& from = corners_[i];
        const Vector& to = corners_[i + 1 < corners_.size() ? i + 1 : 0];
        const double beyond = direction.dot(from) - least;
        const double beyond_to = direction.dot(to) - least;
        if (beyond > 0.0) {
            kept_.push_back(from);
        }
        if ((beyond > 0.0) != (beyond_to > 0.0)) {
            kept_.push_back(from + beyond / (beyond - beyond_to) * (to - from));
        }
    }
    corners_.swap(kept_);
}

Vector ConvexPiece::nearest() const {
    Vector nearest = Vector::Zero();
    double squared = std::numeric_limits<double>::infinity();
    bool holds_zero = true;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Vector& from = corners_[i];
        const Vector& to = corners_[i + 1 < corners_.size() ? i + 1 : 0];
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
    for (const Vector& corner : corners_) {
        sum += corner;
    }
    return sum / static_cast<double>(corners_.size());
}

}  // namespace nearfield::mtv
