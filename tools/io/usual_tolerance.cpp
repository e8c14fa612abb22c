#include <nearfield/query.hpp>

#include <tools/io/usual_tolerance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::tools {
namespace {

/// What the coordinates of a shape span, and how large they become.
struct Range {
    double longer_side = 0.0;
    double magnitude = 0.0;
};

Range range_of(const PlacedRings& shape) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Vector2 low{infinite, infinite};
    Vector2 high{-infinite, -infinite};
    double radius = 0.0;
    for (const Ring& ring : shape.rings) {
        for (const Vector2 vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
            radius = std::max(radius, std::hypot(vertex.x, vertex.y));
        }
    }
    const double distance = std::hypot(shape.translation.x, shape.translation.y);
    return {std::max(high.x - low.x, high.y - low.y), radius + distance};
}

}  // namespace

double usual_tolerance(const PlacedRings& a, const PlacedRings& b) {
    const Range range_a = range_of(a);
    const Range range_b = range_of(b);
    // Above what the library demands: 4096 roundings of the coordinates, 1 / max_deviation of the
    // deviations.
    constexpr double roundings = 16384.0 * std::numeric_limits<double>::epsilon();
    constexpr double deviations = 1.001 / max_deviation;
    return std::max({std::max(range_a.longer_side, range_b.longer_side) / 1000.0,
                     roundings * std::max(range_a.magnitude, range_b.magnitude),
                     deviations * (a.deviation + b.deviation)});
}

}  // namespace nearfield::tools
