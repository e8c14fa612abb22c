#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/shape.hpp>

namespace nearfield::exact {

/// A polygon on its way from one pose to another in a unit of time: translation and angle both
/// change at a constant rate. A vertex then moves on a straight line that turns: its velocity is
/// that of the origin of the shape's coordinates and, at right angles to the way there, the spin;
/// its acceleration has the length spin^2 times that way.
class Motion {
public:
    Motion(const geometry::Polygon& polygon, const Pose& start, const Pose& end);

    [[nodiscard]] const geometry::Polygon& polygon() const { return *polygon_; }
    /// Where it is at a time from 0 to 1. The start and the end are met exactly.
    [[nodiscard]] Pose at(double time) const;

    /// Of the origin of the shape's own coordinates, world units a unit of time.
    [[nodiscard]] const geometry::Vector& velocity() const { return velocity_; }
    /// Radians a unit of time.
    [[nodiscard]] double spin() const { return spin_; }
    /// The farthest vertex from the centre of the polygon.
    [[nodiscard]] double radius() const { return radius_; }
    /// No vertex is farther from the origin of the shape's own coordinates, about which it turns.
    [[nodiscard]] double reach() const { return reach_; }
    /// The largest number that placing a vertex goes through, the arc it has turned by included.
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

/// A moving polygon at one time: how its points move from there on.
struct MotionState {
    /// Of the shape's own coordinates, in the world.
    geometry::Vector origin = geometry::Vector::Zero();
    /// Of the polygon, in the world.
    geometry::Vector centre = geometry::Vector::Zero();
    /// Of the origin.
    geometry::Vector velocity = geometry::Vector::Zero();
    double spin = 0.0;

    MotionState() = default;
    MotionState(const Motion& motion, const Pose& pose);

    /// Of a point of the polygon that is there now.
    [[nodiscard]] geometry::Vector velocity_at(const geometry::Vector& point) const {
        const geometry::Vector arm = point - origin;
        return velocity + spin * geometry::Vector(-arm.y(), arm.x());
    }
    /// The length of its acceleration, the same at all times.
    [[nodiscard]] double acceleration_at(const geometry::Vector& point) const {
        return spin == 0.0 ? 0.0 : spin * spin * (point - origin).norm();
    }
};

/// How far a point of one moving polygon and a point of another can move against each other, from
/// one time on.
class RelativeMotion {
public:
    RelativeMotion() = default;
    RelativeMotion(const Motion& a, const MotionState& at_a, const Motion& b,
                   const MotionState& at_b);

    /// By no more than this within a time.
    [[nodiscard]] double length(double time) const;
    /// And the way there, however it bends, is no longer than this.
    [[nodiscard]] double path(double time) const;
    /// By no more than a length within this time, which may be infinite.
    [[nodiscard]] double time(double length) const;

private:
    // path <= speed * time + bend * time^2 / 2, by what the centres and the radii do; and
    // length <= drift * time + turned, since what turns stays within its reach.
    double speed_ = 0.0;
    double bend_ = 0.0;
    double drift_ = 0.0;
    double turned_ = 0.0;
};

}  // namespace nearfield::exact
