#pragma once

#include <tools/simulation/scene.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace nearfield::viewer {

/// A damped spring between a point of a body and the mouse. On a deformable body it holds a section
/// of the boundary, because a force at a single point would tear it.
class Drag {
public:
    /// A straight line from the held point to the mouse.
    struct Line {
        Vector2 from;
        Vector2 to;
    };

    /// Grabs the last body of a scene that contains the point, if there is one.
    bool grab(const simulation::Scene& scene, Vector2 point);
    void move(Vector2 target) { target_ = target; }
    void release() { held_.reset(); }

    /// Pushes the held body. Call before each step.
    void pull(const simulation::Scene& scene) const;
    [[nodiscard]] std::optional<Line> line(const simulation::Scene& scene) const;
    /// True if the held body cannot be moved by forces.
    [[nodiscard]] bool in_vain(const simulation::Scene& scene) const;

private:
    /// A vertex of a deformable body and its share of the force.
    struct Share {
        std::size_t vertex = 0;
        double part = 0.0;
    };
    struct Hold {
        std::size_t body = 0;
        Vector2 own_place;          ///< for a rigid body: the point in body coordinates
        std::vector<Share> shares;  ///< for a deformable body
        Vector2 offset;             ///< from the weighted mean of these to the point
    };
    /// The grips that a hold consists of, with their weights.
    struct WeightedGrip {
        simulation::Grip grip;
        double part = 0.0;
    };

    [[nodiscard]] std::vector<WeightedGrip> grips(const simulation::Body& body) const;
    [[nodiscard]] Vector2 point(const simulation::Body& body) const;

    std::optional<Hold> held_;
    Vector2 target_;
};

}  // namespace nearfield::viewer
