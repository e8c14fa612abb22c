#include <engine/geometry/containment.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::geometry {

void Containment::answer(const PlacedPolygon& placed) {
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
    const std::span<const Vector> vertices = polygon.vertices();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        const std::uint32_t end = polygon.ring_end(ring);
        Vector a = vertices[end - 1];
        for (const Vector& b : vertices.subspan(begin, end - begin)) {
            // Half open, as contains() has it.
            const double low = std::min(a.y(), b.y());
            const double high = std::max(a.y(), b.y());
            const bool upward = b.y() > a.y();
            auto level =
                std::lower_bound(levels_.begin(), levels_.end(), low,
                                 [](const Level& entry, double y) { return entry.point.y() < y; });
            for (; level != levels_.end() && level->point.y() < high; ++level) {
                const bool left = cross(b - a, level->point - a) > 0.0;
                inside_[level->index] ^= static_cast<std::uint8_t>(left == upward);
            }
            a = b;
        }
    }
}

bool Containment::any_inside() const {
    return std::find(inside_.begin(), inside_.end(), 1) != inside_.end();
}

}  // namespace nearfield::geometry
