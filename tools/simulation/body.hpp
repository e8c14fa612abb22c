#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::simulation {

/// A point of application on a body: found once, used for velocity and force alike.
struct Grip {
    Vector2 point;         ///< in world coordinates
    std::size_t edge = 0;  ///< for a deformable body: the edge that contains the point
    double part = 0.0;     ///< and the position on it: 0 at its first vertex, 1 at its second
};

/// A body's conserved quantities.
struct Inventory {
    double mass = 0.0;  ///< of the freely moving part
    Vector2 momentum;
    double angular_momentum = 0.0;  ///< about the world's origin
    double kinetic_energy = 0.0;
    double elastic_energy = 0.0;  ///< for a deformed body
};

/// A body that moves and can be pushed. A step consists of forces, accelerate(), then move(), which
/// may be repeated with other times until settle() accepts the step.
class Body {
public:
    virtual ~Body() = default;

    /// The outline in body coordinates, and the pose of the body.
    [[nodiscard]] virtual const std::vector<Ring>& rings() const = 0;
    [[nodiscard]] virtual Pose pose() const = 0;
    /// True if the rings change from step to step.
    [[nodiscard]] virtual bool deforms() const = 0;
    /// True if forces can move the body or a part of it.
    [[nodiscard]] virtual bool movable() const = 0;
    [[nodiscard]] virtual Vector2 center() const = 0;
    [[nodiscard]] virtual Inventory inventory() const = 0;

    /// Finds the grip for a point of the boundary.
    [[nodiscard]] virtual Grip grip(Vector2 point) const = 0;
    [[nodiscard]] virtual Vector2 velocity(const Grip& grip) const = 0;
    /// The velocity along a unit vector that a unit impulse along it gives to the point.
    [[nodiscard]] virtual double yielding(const Grip& grip, Vector2 direction) const = 0;
    /// Adds a force that acts during the next accelerate().
    virtual void push(const Grip& grip, Vector2 force) = 0;
    /// Adds a uniform acceleration, such as gravity.
    virtual void pull(Vector2 acceleration) = 0;
    /// Adds a drag on the motion of the body as a whole: deceleration per speed.
    virtual void slow_down(double drag) = 0;
    /// Applies an impulse.
    virtual void kick(const Grip& grip, Vector2 impulse) = 0;

    /// Integrates velocities over `time` under the added forces, which are cleared, and the
    /// internal forces.
    virtual void accelerate(double time) = 0;
    /// Moves to the position `time` after the last settle(), at the present velocity.
    virtual void move(double time) = 0;
    virtual void settle() = 0;

protected:
    Body() = default;
    Body(const Body&) = default;
    Body& operator=(const Body&) = default;
};

}  // namespace nearfield::simulation
