#pragma once

#include <tools/dynamics/scene.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace nearfield::viewer {

/// A damped spring between a point of a body and the mouse. A deformable body is held by a stretch
/// of its boundary, so that it is not torn at a point.
class Drag {
public:
    /// A straight line from what is held to the mouse.
    struct Line {
        Vector2 from;
        Vector2 to;
    };

    /// Takes hold of the last body of a scene that has the point inside, if there is one.
    bool grab(const dynamics::Scene& scene, Vector2 point);
    void move(Vector2 target) { target_ = target; }
    void release() { held_.reset(); }

    /// Pushes the body that is held; before each step.
    void pull(const dynamics::Scene& scene) const;
    [[nodiscard]] std::optional<Line> line(const dynamics::Scene& scene) const;
    /// What is held cannot be moved: it goes its own way.
    [[nodiscard]] bool in_vain(const dynamics::Scene& scene) const;

private:
    /// A vertex of a deformable body and its share of what the whole hold feels.
    struct Share {
        std::size_t vertex = 0;
        double part = 0.0;
    };
    struct Hold {
        std::size_t body = 0;
        Vector2 own_place;          ///< of a rigid body: the point, in its own coordinates
        std::vector<Share> shares;  ///< of a deformable one
        Vector2 offset;             ///< from where these are together to the point
    };
    /// What a hold is made of, as bodies take it.
    struct WeightedGrip {
        dynamics::Grip grip;
        double part = 0.0;
    };

    [[nodiscard]] std::vector<WeightedGrip> grips(const dynamics::Body& body) const;
    [[nodiscard]] Vector2 point(const dynamics::Body& body) const;

    std::optional<Hold> held_;
    Vector2 target_;
};

}  // namespace nearfield::viewer
