#include <engine/geometry/transformed_polygon.hpp>
#include <engine/toi/motion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::toi {

using geometry::Polygon;
using geometry::to_vector;
using geometry::Vector;

namespace {

constexpr double at_no_time = std::numeric_limits<double>::infinity();

}  // namespace

Motion::Motion(const Polygon& polygon, const Pose& start, const Pose& end)
    : polygon_(&polygon),
      start_(start),
      end_(end),
      velocity_(to_vector(end.translation) - to_vector(start.translation)),
      spin_(end.angle - start.angle) {
    double squared = 0.0;
    for (const Vector& vertex : polygon.vertices()) {
        squared = std::max(squared, vertex.squaredNorm());
    }
    // Slightly increased for the rounding of the square root.
    radius_ = std::sqrt(squared) * (1.0 + 4.0 * std::numeric_limits<double>::epsilon());
    reach_ = radius_ + polygon.centre().norm();
    const double angle = std::max(std::abs(start.angle), std::abs(end.angle));
    magnitude_ = std::max(to_vector(start.translation).norm(), to_vector(end.translation).norm()) +
                 (1.0 + angle) * reach_;
}

MotionState::MotionState(const Motion& motion, const Pose& pose)
    : origin(to_vector(pose.translation)),
      centre(geometry::TransformedPolygon(motion.polygon(), pose).translation()),
      velocity(motion.velocity()),
      spin(motion.spin()) {}

Pose Motion::at(double time) const {
    const double left = 1.0 - time;
    const auto between = [&](double start, double end) {
        return start == end ? start : left * start + time * end;
    };
    return {{between(start_.translation.x, end_.translation.x),
             between(start_.translation.y, end_.translation.y)},
            between(start_.angle, end_.angle)};
}

RelativeMotion::RelativeMotion(const Motion& a, const MotionState& at_a, const Motion& b,
                               const MotionState& at_b)
    : drift_((b.velocity() - a.velocity()).norm()) {
    const Vector between = at_b.velocity_at(at_b.centre) - at_a.velocity_at(at_a.centre);
    speed_ = between.norm() + std::abs(a.spin()) * a.radius() + std::abs(b.spin()) * b.radius();
    bend_ = at_a.acceleration_at(at_a.centre) + at_b.acceleration_at(at_b.centre);
    // At most to the opposite side of the origin.
    turned_ = (a.spin() != 0.0 ? 2.0 * a.reach() : 0.0) + (b.spin() != 0.0 ? 2.0 * b.reach() : 0.0);
}

double RelativeMotion::length(double time) const {
    return std::min(path(time), drift_ * time + turned_);
}

double RelativeMotion::path(double time) const {
    return speed_ * time + 0.5 * bend_ * time * time;
}

double RelativeMotion::time(double length) const {
    const double root = speed_ + std::sqrt(speed_ * speed_ + 2.0 * bend_ * length);
    const double turning = root > 0.0 ? 2.0 * length / root : at_no_time;
    if (length <= turned_) {
        return turning;
    }
    return std::max(turning, drift_ > 0.0 ? (length - turned_) / drift_ : at_no_time);
}

}  // namespace nearfield::toi
