#pragma once

#include <tools/simulation/body.hpp>
#include <tools/simulation/plane.hpp>

namespace nearfield::simulation {

/// The material of a deformable body.
struct Softness {
    double density = 1.0;  ///< mass per area; the boundary carries it
    /// Springs along the boundary between the displacements of neighbours. They carry waves, at the
    /// speed sqrt(tension * spacing / mass of a vertex).
    double tension = 1.0;
    /// Springs from each vertex to its position in the undeformed body: force per displacement and
    /// per length of boundary.
    double support = 1.0;
    double incompressibility = 1.0;  ///< pressure per relative change of the area
    double damping = 0.0;            ///< between neighbours: force per relative speed
};

/// A body with one ring: a chain of masses and springs whose area is preserved by pressure. Its
/// rest shape is the initial one, wherever it has moved or turned: internal forces conserve
/// momentum and angular momentum.
class DeformableBody final : public Body {
public:
    /// `ring`: vertices at rest in world coordinates. Held vertices never move.
    DeformableBody(Ring ring, const Softness& softness, std::vector<bool> held = {});

    [[nodiscard]] const std::vector<Ring>& rings() const override { return rings_; }
    [[nodiscard]] Pose pose() const override { return {}; }
    [[nodiscard]] bool deforms() const override { return true; }
    [[nodiscard]] bool movable() const override { return true; }
    [[nodiscard]] Vector2 center() const override;
    [[nodiscard]] Inventory inventory() const override;

    [[nodiscard]] Grip grip(Vector2 point) const override;
    [[nodiscard]] Vector2 velocity(const Grip& grip) const override;
    [[nodiscard]] double yielding(const Grip& grip, Vector2 direction) const override;
    void push(const Grip& grip, Vector2 force) override;
    void pull(Vector2 acceleration) override;
    void slow_down(double drag) override;
    void kick(const Grip& grip, Vector2 impulse) override;
    void accelerate(double time) override;
    void move(double time) override;
    void settle() override;

    [[nodiscard]] const Ring& outline() const { return rings_.front(); }
    [[nodiscard]] const Ring& rest() const { return rest_; }
    [[nodiscard]] double area() const;
    [[nodiscard]] double rest_area() const { return rest_area_; }
    void push_vertex(std::size_t vertex, Vector2 force) { forces_[vertex] += force; }
    /// Displaces a vertex and sets its velocity. Call before the first step.
    void disturb(std::size_t vertex, Vector2 displacement, Vector2 velocity);

private:
    /// The pose of the undeformed body.
    struct Frame {
        Vector2 center;
        double angle = 0.0;
    };

    [[nodiscard]] std::size_t after(std::size_t vertex) const {
        return vertex + 1 == rest_.size() ? 0 : vertex + 1;
    }
    [[nodiscard]] Frame frame() const;
    [[nodiscard]] double inverse_mass(std::size_t vertex) const {
        return held_[vertex] ? 0.0 : 1.0 / vertex_mass_;
    }
    void pull_into_shape();
    void damp();

    Softness softness_;
    Ring rest_;  // relative to the centre, at rest
    Vector2 rest_center_;
    double rest_area_ = 0.0;
    double spacing_ = 0.0;  // mean length of an edge at rest
    double vertex_mass_ = 0.0;
    bool free_ = true;  // no vertex is held
    std::vector<bool> held_;
    std::vector<Ring> rings_;  // always one ring
    std::vector<Vector2> velocities_;
    std::vector<Vector2> forces_;
    Ring settled_;
};

}  // namespace nearfield::simulation
