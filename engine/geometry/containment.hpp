#pragma once

#include <engine/geometry/placed_polygon.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::geometry {

/// Answers for many points at once whether they lie in a polygon, as contains() does for one: every
/// edge is held against those points alone that are level with it. Keeps its memory.
class Containment {
public:
    void clear() { points_.clear(); }
    /// Asks for a point in world coordinates; its answer has the index of the asking.
    void ask(const Vector& point) { points_.push_back(point); }

    /// Answers all that was asked.
    void answer(const PlacedPolygon& placed);
    [[nodiscard]] bool inside(std::size_t index) const { return inside_[index] != 0; }
    [[nodiscard]] bool any_inside() const;

private:
    struct Level {
        Vector point;  // relative to the polygon's centre
        std::size_t index = 0;
    };

    /// Counts the crossings of a ring with the rays from all points.
    void cross_levels(std::span<const Vector> ring);

    std::vector<Vector> points_;
    std::vector<Level> levels_;  // from the lowest point to the highest
    std::vector<std::uint8_t> inside_;
};

}  // namespace nearfield::geometry
