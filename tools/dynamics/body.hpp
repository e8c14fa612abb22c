#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::dynamics {

/// Where something takes hold of a body: found once, used for velocity and force alike.
struct Grip {
    Vector2 point;         ///< in the world
    std::size_t edge = 0;  ///< of a deformable body: the edge that holds the point
    double part = 0.0;     ///< and where on it, 0 at its first vertex, 1 at its second
};

/// What a body has of the quantities that nature conserves.
struct Inventory {
    double mass = 0.0;  ///< of what can move freely
    Vector2 momentum;
    double angular_momentum = 0.0;  ///< about the world's origin
    double kinetic_energy = 0.0;
    double elastic_energy = 0.0;  ///< of a deformed body
};

/// Something that moves and can be pushed. A step is: pushes, accelerate(), then move(), which can
/// be called again with another time until the step is accepted with settle().
class Body {
public:
    virtual ~Body() = default;

    /// The outline in its own coordinates, and where that is.
    [[nodiscard]] virtual const std::vector<Ring>& rings() const = 0;
    [[nodiscard]] virtual Pose pose() const = 0;
    /// The rings change from step to step.
    [[nodiscard]] virtual bool deforms() const = 0;
    /// Can be moved by forces, as a whole or in part.
    [[nodiscard]] virtual bool movable() const = 0;
    [[nodiscard]] virtual Vector2 center() const = 0;
    [[nodiscard]] virtual Inventory inventory() const = 0;

    /// Takes hold of a point of the boundary.
    [[nodiscard]] virtual Grip grip(Vector2 point) const = 0;
    [[nodiscard]] virtual Vector2 velocity(const Grip& grip) const = 0;
    /// The velocity along a unit vector that a unit impulse along it gives the point.
    [[nodiscard]] virtual double yielding(const Grip& grip, Vector2 direction) const = 0;
    /// A force until the next accelerate().
    virtual void push(const Grip& grip, Vector2 force) = 0;
    /// A force on every part of it, as an acceleration: gravity.
    virtual void pull(Vector2 acceleration) = 0;
    /// A force against its motion as a whole, as a deceleration by speed.
    virtual void slow_down(double drag) = 0;
    /// A sudden change of velocity.
    virtual void kick(const Grip& grip, Vector2 impulse) = 0;

    /// Velocities after `time` under the pushes, which are spent, and what holds the body together.
    virtual void accelerate(double time) = 0;
    /// Where it is `time` after the last settle(), at its present velocity.
    virtual void move(double time) = 0;
    virtual void settle() = 0;

protected:
    Body() = default;
    Body(const Body&) = default;
    Body& operator=(const Body&) = default;
};

}  // namespace nearfield::dynamics
