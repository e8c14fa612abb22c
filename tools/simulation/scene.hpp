#pragma once

#include <nearfield/shape.hpp>

#include <tools/simulation/body.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::simulation {

/// Influences on every body of a scene.
struct Surroundings {
    Vector2 gravity;          ///< acceleration
    Vector2 middle;           ///< the centre of attraction
    double attraction = 0.0;  ///< acceleration per distance from the middle
    double drag = 0.0;        ///< deceleration per speed, for a body as a whole
};

/// The response where bodies touch.
struct Touch {
    // Penalty, for every length of boundary inside the other body:
    double stiffness = 1000.0;  ///< force per depth and length
    double damping = 10.0;      ///< force per speed and length, along the way out and across it
    // Backtracking:
    double restitution = 0.3;  ///< speed after divided by speed before
    // Both:
    double friction = 0.2;  ///< maximum force across the way out divided by the force along it
};

/// The appearance of a body.
struct Look {
    double hue = 0.0;     ///< in turns
    double height = 0.0;  ///< above the plane; 0: a flat plate
};

/// Bodies and their driving forces.
struct Scene {
    std::string name;
    std::vector<std::unique_ptr<Body>> bodies;
    std::vector<Look> looks;  ///< one per body
    Surroundings surroundings;
    Touch touch;
    double tolerance = 0.01;  ///< d for the queries
    double frame_time = 1.0 / 60.0;
    unsigned steps = 4;  ///< of equal duration, per frame
    /// Called with the time before each step, to push, twist and direct bodies.
    std::function<void(double)> act;
    Rectangle view;  ///< the part shown in a picture
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

}  // namespace nearfield::simulation
