#include <tools/io/same_rings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nearfield::tools {
namespace {

/// A vertex of the second list.
struct Corner {
    double x = 0.0;
    std::size_t ring = 0;
    std::size_t vertex = 0;
};

/// True if the vertices of `ring` from the first on are those of `other` from `start` on, whose
/// numbers change by `step`. Precondition: the sizes are equal.
bool match_from(const Ring& ring, const Ring& other, std::size_t start, std::size_t step,
                double distance) {
    std::size_t at = start;
    for (const Vector2& vertex : ring) {
        if (!(std::abs(vertex.x - other[at].x) <= distance &&
              std::abs(vertex.y - other[at].y) <= distance)) {
            return false;
        }
        at = (at + step) % other.size();
    }
    return true;
}

}  // namespace

bool are_same_rings(std::span<const Ring> first, std::span<const Ring> second, double distance) {
    if (first.size() != second.size()) {
        return false;
    }
    std::vector<Corner> corners;
    for (std::size_t ring = 0; ring < second.size(); ++ring) {
        for (std::size_t vertex = 0; vertex < second[ring].size(); ++vertex) {
            corners.push_back({second[ring][vertex].x, ring, vertex});
        }
    }
    std::sort(corners.begin(), corners.end(),
              [](const Corner& a, const Corner& b) { return a.x < b.x; });
    std::vector<bool> is_taken(second.size());
    return std::all_of(first.begin(), first.end(), [&](const Ring& ring) {
        if (ring.empty()) {
            return false;
        }
        auto corner = std::lower_bound(corners.begin(), corners.end(), ring.front().x - distance,
                                       [](const Corner& a, double x) { return a.x < x; });
        for (; corner != corners.end() && corner->x <= ring.front().x + distance; ++corner) {
            const Ring& other = second[corner->ring];
            if (!is_taken[corner->ring] && other.size() == ring.size() &&
                (match_from(ring, other, corner->vertex, 1, distance) ||
                 match_from(ring, other, corner->vertex, other.size() - 1, distance))) {
                is_taken[corner->ring] = true;
                return true;
            }
        }
        return false;
    });
}

}  // namespace nearfield::tools
