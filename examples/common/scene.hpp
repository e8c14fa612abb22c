#pragma once

#include <nearfield/shape.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::examples {

/// A shape with its pose.
struct Body {
    std::vector<Ring> rings;
    Pose pose;
};

/// Two shapes that the mouse can drag. World coordinates: y up, the origin in the middle.
class Scene {
public:
    Scene();

    [[nodiscard]] const std::array<Body, 2>& bodies() const { return bodies_; }
    [[nodiscard]] std::array<Pose, 2> poses() const { return {bodies_[0].pose, bodies_[1].pose}; }
    /// Grows with every change; never 0.
    [[nodiscard]] std::uint64_t version() const { return version_; }

    /// Grabs the shape under the mouse, if there is one.
    void press(const Vector2& mouse);
    /// Moves the grabbed shape.
    void move(const Vector2& mouse);
    void release() { held_.reset(); }

private:
    struct Hold {
        std::size_t body = 0;
        Vector2 offset;  ///< from the mouse to the body's translation
    };

    std::array<Body, 2> bodies_;
    std::optional<Hold> held_;
    std::uint64_t version_ = 1;
};

/// Transforms shape coordinates to world coordinates.
[[nodiscard]] Vector2 place(const Pose& pose, const Vector2& point);
/// True if the body contains a point in world coordinates, by the odd-even rule.
[[nodiscard]] bool contains(const Body& body, const Vector2& point);

/// The part of the world that a window shows: `height` units from its lower to its upper edge, with
/// the origin in the middle. Pixels count from the upper left corner.
struct View {
    static constexpr double height = 6.0;
    double width_in_pixels = 0.0;
    double height_in_pixels = 0.0;

    [[nodiscard]] double pixels_per_unit() const { return height_in_pixels / height; }
    [[nodiscard]] Vector2 to_pixel(const Vector2& world) const;
    [[nodiscard]] Vector2 to_world(const Vector2& pixel) const;
};

/// The scripted mouse input of a screenshot: it grabs the second shape and moves it in a straight
/// line of `drag_steps` steps by the offset given on the command line.
inline constexpr Vector2 drag_from{1.9, 0.9};
inline constexpr int drag_steps = 8;
[[nodiscard]] Vector2 drag_position(const Vector2& by, int step);

}  // namespace nearfield::examples
