#pragma once

#include <nearfield/shape.hpp>

#include <tools/dynamics/body.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::dynamics {

/// What acts on every body of a scene.
struct Surroundings {
    Vector2 gravity;          ///< acceleration
    Vector2 middle;           ///< pulls everything to it:
    double attraction = 0.0;  ///< acceleration by distance from the middle
    double drag = 0.0;        ///< deceleration by speed, of a body as a whole
};

/// What happens where bodies touch.
struct Touch {
    // Penalty: of every length of boundary inside the other body,
    double stiffness = 1000.0;  ///< force by depth and length
    double damping = 10.0;      ///< force by speed and length, along the way out and across it
    // Backtracking:
    double restitution = 0.3;  ///< speed after by speed before
    // Both:
    double friction = 0.2;  ///< most force across the way out by force along it
};

/// What a body looks like.
struct Look {
    double hue = 0.0;     ///< in turns
    double height = 0.0;  ///< above the plane; 0: a flat plate
};

/// What moves, and what makes it move.
struct Scene {
    std::string name;
    std::vector<std::unique_ptr<Body>> bodies;
    std::vector<Look> looks;  ///< one a body
    Surroundings surroundings;
    Touch touch;
    double tolerance = 0.01;  ///< d of the queries
    double frame_time = 1.0 / 60.0;
    unsigned steps = 4;  ///< of equal length, in a frame
    /// Called before each step with the time, to push, twist and direct bodies.
    std::function<void(double)> act;
    Rectangle view;  ///< what a picture shows
};

/// The number of edges of all outlines.
[[nodiscard]] inline std::size_t line_count(const Scene& scene) {
    std::size_t count = 0;
    for (const std::unique_ptr<Body>& body : scene.bodies) {
        for (const Ring& ring : body->rings()) {
            count += ring.size();
        }
    }
    return count;
}

}  // namespace nearfield::dynamics
