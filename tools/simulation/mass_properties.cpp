#include <tools/simulation/mass_properties.hpp>
#include <tools/simulation/plane.hpp>

#include <cstddef>

namespace nearfield::simulation {
namespace {

/// Integrals over an area of density 1: of 1, of the position and of the squared distance from the
/// origin.
struct Moments {
    double area = 0.0;
    Vector2 first;
    double second = 0.0;
};

/// The moments of the triangles between the origin and each edge, with the sign of the ring's
/// orientation.
Moments moments_of(const Ring& ring, Vector2 origin) {
    Moments sum;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 a = ring[i] - origin;
        const Vector2 b = ring[(i + 1) % ring.size()] - origin;
        const double twice_area = cross(a, b);
        sum.area += twice_area / 2.0;
        sum.first += (twice_area / 6.0) * (a + b);
        sum.second += twice_area / 12.0 * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    return sum;
}

bool is_inside(Vector2 point, const Ring& ring) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 a = ring[i];
        const Vector2 b = ring[(i + 1) % ring.size()];
        if ((a.y > point.y) != (b.y > point.y) &&
            point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside;
}

/// Rings that do not cross are nested entirely or not at all.
bool is_hole(std::span<const Ring> rings, std::size_t index) {
    bool hole = false;
    for (std::size_t other = 0; other < rings.size(); ++other) {
        if (other != index && is_inside(rings[index].front(), rings[other])) {
            hole = !hole;
        }
    }
    return hole;
}

}  // namespace

MassProperties mass_properties(std::span<const Ring> rings) {
    // Relative to a vertex: relative to a distant origin of a map, differences would be lost to
    // rounding.
    const Vector2 origin = rings.front().front();
    Moments sum;
    for (std::size_t index = 0; index < rings.size(); ++index) {
        const Moments ring = moments_of(rings[index], origin);
        const double sign = (ring.area < 0.0) == is_hole(rings, index) ? 1.0 : -1.0;
        sum.area += sign * ring.area;
        sum.first += sign * ring.first;
        sum.second += sign * ring.second;
    }
    const Vector2 offset = (1.0 / sum.area) * sum.first;
    return {sum.area, origin + offset, sum.second - sum.area * dot(offset, offset)};
}

}  // namespace nearfield::simulation
