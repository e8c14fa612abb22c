#pragma once

#include <nearfield/shape.hpp>

#include <tools/simulation/body.hpp>

#include <span>

namespace nearfield::simulation {

/// The mass properties of a plate of density 1.
struct MassProperties {
    double area = 0.0;
    Vector2 centroid;
    double inertia = 0.0;  ///< about the centroid and the axis normal to the plane
};

/// The properties of the shape that rings fill by the odd-even rule: non-convex outlines, holes,
/// islands in holes and separate parts, in any order and orientation. Precondition: no ring crosses
/// itself or another.
[[nodiscard]] MassProperties mass_properties(std::span<const Ring> rings);

/// How a rigid body may move.
enum class Freedom {
    free,
    turning,   ///< about its fixed centre
    directed,  ///< as its velocity and spin are set, regardless of forces
};

/// A plate of constant thickness.
class RigidBody final : public Body {
public:
    /// `rings` may have any origin; the body's own coordinates are relative to the centroid. `pose`
    /// applies to the rings as given. `density`: mass per area.
    RigidBody(std::vector<Ring> rings, const Pose& pose, Freedom freedom = Freedom::free,
              double density = 1.0);

    [[nodiscard]] const std::vector<Ring>& rings() const override { return rings_; }
    [[nodiscard]] Pose pose() const override { return {position_, angle_}; }
    [[nodiscard]] bool deforms() const override { return false; }
    [[nodiscard]] bool movable() const override { return inverse_inertia_ > 0.0; }
    [[nodiscard]] Vector2 center() const override { return position_; }
    [[nodiscard]] Inventory inventory() const override;

    [[nodiscard]] Grip grip(Vector2 point) const override { return {point}; }
    [[nodiscard]] Vector2 velocity(const Grip& grip) const override;
    [[nodiscard]] double yielding(const Grip& grip, Vector2 direction) const override;
    void push(const Grip& grip, Vector2 force) override;
    void pull(Vector2 acceleration) override;
    void slow_down(double drag) override;
    void kick(const Grip& grip, Vector2 impulse) override;
    void accelerate(double time) override;
    void move(double time) override;
    void settle() override;

    [[nodiscard]] const MassProperties& plate() const { return plate_; }
    [[nodiscard]] double mass() const { return mass_; }
    [[nodiscard]] double inertia() const { return inertia_; }
    [[nodiscard]] double angle() const { return angle_; }  ///< counts full turns
    [[nodiscard]] Vector2 velocity() const { return velocity_; }
    [[nodiscard]] double spin() const { return spin_; }  ///< radians per second, counter-clockwise
    void set_motion(Vector2 velocity, double spin);
    void twist(double torque) { torque_ += torque; }

private:
    MassProperties plate_;
    std::vector<Ring> rings_;
    double mass_ = 0.0;
    double inertia_ = 0.0;
    double inverse_mass_ = 0.0;     // 0: forces do not move it
    double inverse_inertia_ = 0.0;  // 0: they do not turn it
    Vector2 position_;              // of the centroid
    double angle_ = 0.0;
    Vector2 velocity_;
    double spin_ = 0.0;
    Vector2 settled_position_;
    double settled_angle_ = 0.0;
    Vector2 force_;
    double torque_ = 0.0;
};

}  // namespace nearfield::simulation
