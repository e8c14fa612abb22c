#include <tools/drawing/view.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace nearfield::tools {
namespace {

double width(const Rectangle& rectangle) {
    return rectangle.max.x - rectangle.min.x;
}
double height(const Rectangle& rectangle) {
    return rectangle.max.y - rectangle.min.y;
}

/// Clips a ring to a half-plane bounded by an axis-parallel line (Sutherland and Hodgman). Keeps
/// points where sign * coordinate <= sign * limit; `axis` selects the coordinate.
std::vector<Vector2> clip_half_plane(const std::vector<Vector2>& ring, double Vector2::*axis,
                                     double sign, double limit) {
    std::vector<Vector2> kept;
    for (std::size_t index = 0; index < ring.size(); ++index) {
        const Vector2& from = ring[index];
        const Vector2& to = ring[(index + 1) % ring.size()];
        const double from_excess = sign * (from.*axis - limit);
        const double to_excess = sign * (to.*axis - limit);
        if (from_excess <= 0.0) {
            kept.push_back(from);
        }
        if ((from_excess <= 0.0) != (to_excess <= 0.0)) {
            const double weight = from_excess / (from_excess - to_excess);
            kept.push_back({std::lerp(from.x, to.x, weight), std::lerp(from.y, to.y, weight)});
        }
    }
    return kept;
}

}  // namespace

View::View(const Rectangle& world, const Rectangle& page) : page_(page) {
    const double world_width = std::max(width(world), 1e-300);
    const double world_height = std::max(height(world), 1e-300);
    scale_ = std::min(width(page) / world_width, height(page) / world_height);
    const Vector2 half{width(page) / scale_ / 2.0, height(page) / scale_ / 2.0};
    const Vector2 center{std::midpoint(world.min.x, world.max.x),
                         std::midpoint(world.min.y, world.max.y)};
    world_ = {{center.x - half.x, center.y - half.y}, {center.x + half.x, center.y + half.y}};
}

std::vector<Vector2> View::to_page(const Ring& ring) const {
    constexpr double beyond = 100.0;
    std::vector<Vector2> points;
    points.reserve(ring.size());
    for (const Vector2& vertex : ring) {
        points.push_back(to_page(vertex));
    }
    points = clip_half_plane(points, &Vector2::x, -1.0, page_.min.x - beyond);
    points = clip_half_plane(points, &Vector2::x, 1.0, page_.max.x + beyond);
    points = clip_half_plane(points, &Vector2::y, -1.0, page_.min.y - beyond);
    return clip_half_plane(points, &Vector2::y, 1.0, page_.max.y + beyond);
}

Rectangle bounding_box(std::span<const Ring> rings) {
    Rectangle box{rings.front().front(), rings.front().front()};
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            box = united(box, {vertex, vertex});
        }
    }
    return box;
}

Rectangle united(const Rectangle& a, const Rectangle& b) {
    return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
            {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

Rectangle with_margin(const Rectangle& rectangle, double fraction) {
    const double margin = fraction * std::max(width(rectangle), height(rectangle));
    return {{rectangle.min.x - margin, rectangle.min.y - margin},
            {rectangle.max.x + margin, rectangle.max.y + margin}};
}

double round_step(double range, double count) {
    const double raw = range / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double leading = raw / power;
    return power * (leading >= 5.0 ? 5.0 : leading >= 2.0 ? 2.0 : 1.0);
}

}  // namespace nearfield::tools
