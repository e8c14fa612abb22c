#include <engine/exact/boundary.hpp>
#include <engine/exact/leaf.hpp>

#include <cmath>
#include <limits>

namespace nearfield::exact {

using geometry::Vector;

namespace {

constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();

/// True where the ray from `point` towards growing coordinate `along` crosses the edge. Half open
/// across, so that a vertex on the ray counts once.
bool crosses(const Edge& edge, const Vector& point, int along) {
    const int across = 1 - along;
    if ((edge.start[across] > point[across]) == (edge.end[across] > point[across])) {
        return false;
    }
    const double side = geometry::cross(edge.end - edge.start, point - edge.start);
    const bool upward = edge.end[across] > edge.start[across];
    // Left of an edge that goes up means before it on the x axis; on the y axis it is after.
    return along == 0 ? (side > 0.0) == upward : (side < 0.0) == upward;
}

}  // namespace

void Boundary::set(const geometry::PlacedPolygon& polygon) {
    tree_.plant(polygon, std::numeric_limits<std::uint32_t>::max());
}

NearestPoint Boundary::nearest(const Vector& point, std::uint32_t first_guess) {
    NearestPoint best{first_guess, geometry::nearest_on_segment(
                                       point, polygon().vertex(first_guess),
                                       polygon().vertex(polygon().polygon().next(first_guess)))};
    find_nearest(localize::LazyTree::root, point, best);
    return best;
}

void Boundary::find_nearest(std::uint32_t node, const Vector& point, NearestPoint& best) {
    if (Leaf::is_leaf(tree_[node])) {
        const Leaf leaf(polygon(), tree_[node]);
        for (std::uint32_t i = 0; i < leaf.count(); ++i) {
            const Edge edge = leaf.edge(i);
            const auto nearest = geometry::nearest_on_segment(point, edge.start, edge.end);
            if (nearest.squared_distance < best.on_edge.squared_distance) {
                best = {edge.index, nearest};
            }
        }
        return;
    }
    const std::uint32_t first = tree_.first_half(node);
    const double to_first = tree_[first].box.squaredExteriorDistance(point);
    const double to_second = tree_[first + 1].box.squaredExteriorDistance(point);
    const std::uint32_t nearer = to_first <= to_second ? first : first + 1;
    const std::uint32_t farther = nearer == first ? first + 1 : first;
    if (std::min(to_first, to_second) < best.on_edge.squared_distance) {
        find_nearest(nearer, point, best);
    }
    if (std::max(to_first, to_second) < best.on_edge.squared_distance) {
        find_nearest(farther, point, best);
    }
}

bool Boundary::is_unique(const Vector& point, const NearestPoint& nearest, double margin) {
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin;
    return !has_rival(localize::LazyTree::root, point, nearest, limit);
}

bool Boundary::has_rival(std::uint32_t node, const Vector& point, const NearestPoint& nearest,
                         double limit) {
    if (tree_[node].box.squaredExteriorDistance(point) > limit * limit) {
        return false;
    }
    if (!Leaf::is_leaf(tree_[node])) {
        const std::uint32_t first = tree_.first_half(node);
        return has_rival(first, point, nearest, limit) ||
               has_rival(first + 1, point, nearest, limit);
    }
    const Leaf leaf(polygon(), tree_[node]);
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
        const Edge edge = leaf.edge(i);
        if (is_rival(geometry::nearest_on_segment(point, edge.start, edge.end), nearest.on_edge,
                     limit)) {
            return true;
        }
    }
    return false;
}

bool Boundary::contains(const Vector& point) {
    return crossings_are_odd(localize::LazyTree::root, point, 0, no_edge);
}

Vector Boundary::outward_normal(std::uint32_t edge, double parameter) {
    const Vector start = polygon().vertex(edge);
    const Vector end = polygon().vertex(polygon().polygon().next(edge));
    const Vector direction = end - start;
    const double length = direction.norm();
    if (length == 0.0) {
        return Vector::Zero();
    }
    const Vector left(-direction.y() / length, direction.x() / length);
    // The ray leaves the edge across its longer extent; what lies just beyond the edge decides.
    const int along = std::abs(direction.y()) >= std::abs(direction.x()) ? 0 : 1;
    const bool inside_ahead =
        crossings_are_odd(localize::LazyTree::root, start + parameter * direction, along, edge);
    const bool left_is_ahead = left[along] > 0.0;
    return inside_ahead == left_is_ahead ? Vector(-left) : left;
}

bool Boundary::crossings_are_odd(std::uint32_t node, const Vector& point, int along,
                                 std::uint32_t left_out) {
    const geometry::Box& box = tree_[node].box;
    const int across = 1 - along;
    if (box.max()[along] < point[along] || box.min()[across] > point[across] ||
        box.max()[across] < point[across]) {
        return false;
    }
    if (!Leaf::is_leaf(tree_[node])) {
        const std::uint32_t first = tree_.first_half(node);
        return crossings_are_odd(first, point, along, left_out) !=
               crossings_are_odd(first + 1, point, along, left_out);
    }
    bool odd = false;
    const Leaf leaf(polygon(), tree_[node]);
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
        const Edge edge = leaf.edge(i);
        odd = odd != (edge.index != left_out && crosses(edge, point, along));
    }
    return odd;
}

}  // namespace nearfield::exact
