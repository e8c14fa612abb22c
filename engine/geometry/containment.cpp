#include <engine/geometry/containment.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace nearfield::geometry {

void Containment::answer(const TransformedPolygon& placed) {
    inside_.assign(points_.size(), 0);
    if (points_.empty()) {
        return;
    }
    levels_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        levels_.push_back({placed.to_local(points_[i]), i});
    }
    std::sort(levels_.begin(), levels_.end(),
              [](const Level& i, const Level& j) { return i.point.y() < j.point.y(); });

    const Polygon& polygon = placed.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        cross_levels(polygon.vertices().subspan(begin, polygon.ring_end(ring) - begin));
    }
}

void Containment::cross_levels(std::span<const Vector> ring) {
    // `next` is the first point not below the ring's current vertex, so following an edge visits
    // only the points level with that edge. Intervals are half open, as in contains().
    Vector a = ring.back();
    auto next = std::lower_bound(levels_.begin(), levels_.end(), a.y(),
                                 [](const Level& entry, double y) { return entry.point.y() < y; });
    const auto cross_level = [&](const Level& level, const Vector& b, bool upward) {
        const bool left = cross(b - a, level.point - a) > 0.0;
        inside_[level.index] ^= static_cast<std::uint8_t>(left == upward);
    };
    for (const Vector& b : ring) {
        for (; next != levels_.end() && next->point.y() < b.y(); ++next) {
            cross_level(*next, b, true);
        }
        for (; next != levels_.begin() && std::prev(next)->point.y() >= b.y(); --next) {
            cross_level(*std::prev(next), b, false);
        }
        a = b;
    }
}

}  // namespace nearfield::geometry
