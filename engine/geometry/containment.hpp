#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::geometry {

/// Point-in-polygon tests for many points at once, with the answers of contains(): each edge is
/// compared only with the points level with it. Reuses its memory.
class Containment {
public:
    void clear() { points_.clear(); }
    /// Adds a point in world coordinates. Answers are indexed in the order of these calls.
    void ask(const Vector& point) { points_.push_back(point); }

    /// Answers for all points added.
    void answer(const TransformedPolygon& placed);
    [[nodiscard]] bool inside(std::size_t index) const { return inside_[index] != 0; }

private:
    struct Level {
        Vector point;  // relative to the polygon's centre
        std::size_t index = 0;
    };

    /// Flips the parity of each point whose ray the ring crosses.
    void cross_levels(std::span<const Vector> ring);

    std::vector<Vector> points_;
    std::vector<Level> levels_;  // in ascending order of y
    std::vector<std::uint8_t> inside_;
};

}  // namespace nearfield::geometry
