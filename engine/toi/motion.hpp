#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/shape.hpp>

namespace nearfield::toi {

/// A polygon that moves from one pose to another in unit time, with constant translational velocity
/// and spin. A vertex moves on a circle around a point that moves on a straight line. Its velocity
/// is that of the origin of the shape's coordinates plus spin times its arm, rotated a quarter
/// turn; its acceleration has magnitude spin^2 times the arm's length.
class Motion {
public:
    Motion(const geometry::Polygon& polygon, const Pose& start, const Pose& end);

    [[nodiscard]] const geometry::Polygon& polygon() const { return *polygon_; }
    /// The pose at a time from 0 to 1; exact at the start and the end.
    [[nodiscard]] Pose at(double time) const;

    /// Of the origin of the shape's own coordinates, in world units per unit of time.
    [[nodiscard]] const geometry::Vector& velocity() const { return velocity_; }
    /// In radians per unit of time.
    [[nodiscard]] double spin() const { return spin_; }
    /// The largest distance of a vertex from the centre of the polygon.
    [[nodiscard]] double radius() const { return radius_; }
    /// The largest distance of a vertex from the origin of the shape's own coordinates, the centre
    /// of rotation.
    [[nodiscard]] double reach() const { return reach_; }
    /// The largest magnitude that occurs while transforming a vertex, including the arc it has
    /// turned through.
    [[nodiscard]] double magnitude() const { return magnitude_; }

private:
    const geometry::Polygon* polygon_;
    Pose start_;
    Pose end_;
    geometry::Vector velocity_;
    double spin_;
    double radius_ = 0.0;
    double reach_ = 0.0;
    double magnitude_ = 0.0;
};

/// The state of a moving polygon at one time.
struct MotionState {
    /// The origin of the shape's own coordinates, in the world.
    geometry::Vector origin = geometry::Vector::Zero();
    /// The polygon's centre, in the world.
    geometry::Vector centre = geometry::Vector::Zero();
    /// Of the origin.
    geometry::Vector velocity = geometry::Vector::Zero();
    double spin = 0.0;

    MotionState() = default;
    MotionState(const Motion& motion, const Pose& pose);

    /// The velocity of the polygon's point that is at `point` now.
    [[nodiscard]] geometry::Vector velocity_at(const geometry::Vector& point) const {
        const geometry::Vector arm = point - origin;
        return velocity + spin * geometry::Vector(-arm.y(), arm.x());
    }
    /// The magnitude of its acceleration, constant in time.
    [[nodiscard]] double acceleration_at(const geometry::Vector& point) const {
        return spin == 0.0 ? 0.0 : spin * spin * (point - origin).norm();
    }
};

/// Bounds how far a point of one moving polygon and a point of another can move relative to each
/// other from one time on.
class RelativeMotion {
public:
    RelativeMotion() = default;
    RelativeMotion(const Motion& a, const MotionState& at_a, const Motion& b,
                   const MotionState& at_b);

    /// The largest relative displacement within a time.
    [[nodiscard]] double length(double time) const;
    /// The largest length of the path of that displacement, however curved.
    [[nodiscard]] double path(double time) const;
    /// The time within which the relative displacement stays below a length; may be infinite.
    [[nodiscard]] double time(double length) const;

private:
    // path <= speed * time + bend * time^2 / 2, from the centres and the radii; and length <= drift
    // * time + turned, since a rotating point stays within its reach.
    double speed_ = 0.0;
    double bend_ = 0.0;
    double drift_ = 0.0;
    double turned_ = 0.0;
};

}  // namespace nearfield::toi
