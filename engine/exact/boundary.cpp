#include <engine/exact/boundary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::exact {

using geometry::Vector;

namespace {

/// True where the ray from `point` towards growing coordinate `along` crosses the edge. Half open
/// across, so that a vertex on the ray counts once.
bool crosses(const Vector& start, const Vector& end, const Vector& point, int along) {
    const int across = 1 - along;
    if ((start[across] > point[across]) == (end[across] > point[across])) {
        return false;
    }
    const double side = geometry::cross(end - start, point - start);
    const bool upward = end[across] > start[across];
    // Left of an edge that goes up means before it on the x axis; on the y axis it is after.
    return along == 0 ? (side > 0.0) == upward : (side < 0.0) == upward;
}

}  // namespace

void Boundary::set(const PlacedEdges& edges) {
    edges_ = &edges;
    tree_.emplace(edges.tree());
    if (near_.size() < padded(edges.count)) {
        near_.resize(padded(edges.count));
    }
}

void Boundary::set(const geometry::PlacedPolygon& polygon) {
    own_.clear();
    const std::uint32_t index = own_.place(polygon);
    own_.complete(index);
    set(own_[index]);
}

NearestPoint Boundary::nearest(const Vector& point, std::uint32_t first_guess) const {
    const NearEdge guess{first_guess, nearest_on(first_guess, point).squared_distance};
    const std::uint32_t edge = kernels::find_nearer(*tree_, point.x(), point.y(), guess).edge;
    return {edge, nearest_on(edge, point)};
}

std::uint32_t Boundary::keep_inside(std::uint32_t count, const FoundPoints& points) const {
    // Points in one box that no edge's box meets lie on one side, like the last point before them
    // where that is in the box as well.
    constexpr std::uint32_t together = 8;
    std::uint32_t kept = 0;
    bool inside = false;
    Vector last;
    for (std::uint32_t first = 0; first < count; first += together) {
        const std::uint32_t end = std::min(first + together, count);
        geometry::Box box;
        for (std::uint32_t i = first; i < end; ++i) {
            box.extend(Vector(points.x[i], points.y[i]));
        }
        bool on_one_side = false;
        if (first > 0) {
            box.extend(last);
            on_one_side = !kernels::meets(*tree_, extent_of(box));
        }
        for (std::uint32_t i = first; i < end; ++i) {
            last = {points.x[i], points.y[i]};
            inside = on_one_side ? inside : contains(last);
            points.x[kept] = last.x();
            points.y[kept] = last.y();
            kept += inside ? 1 : 0;
        }
    }
    return kept;
}

bool Boundary::is_unique(const Vector& point, const NearestPoint& nearest, double margin) {
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin;
    // What is clearly farther needs no closer look.
    const std::uint32_t count = kernels::find_edges_within(*tree_, point.x(), point.y(),
                                                           beyond_rounding(limit), near_.data());
    if (count <= 1) {
        return true;  // none but the nearest
    }
    return std::none_of(near_.begin(), near_.begin() + count, [&](std::uint32_t edge) {
        return is_rival(nearest_on(edge, point), nearest.on_edge, limit);
    });
}

Vector Boundary::outward_normal(std::uint32_t edge, double parameter) {
    const Vector start = edges_->start(edge);
    const Vector direction = edges_->end(edge) - start;
    const double length = direction.norm();
    if (length == 0.0) {
        return Vector::Zero();
    }
    const Vector left(-direction.y() / length, direction.x() / length);
    // The ray leaves the edge across its longer extent; what lies just beyond the edge decides.
    const int along = std::abs(direction.y()) >= std::abs(direction.x()) ? 0 : 1;
    const bool inside_ahead = crossings_are_odd(start + parameter * direction, along, edge);
    const bool left_is_ahead = left[along] > 0.0;
    return inside_ahead == left_is_ahead ? Vector(-left) : left;
}

bool Boundary::crossings_are_odd(const Vector& point, int along, std::uint32_t left_out) {
    Extent ray{point.x(), point.y(), point.x(), point.y()};
    (along == 0 ? ray.high_x : ray.high_y) = std::numeric_limits<double>::infinity();
    const std::uint32_t count = kernels::find_edges_in(*tree_, ray, near_.data());
    const auto crossed = std::count_if(near_.begin(), near_.begin() + count, [&](std::uint32_t i) {
        return i != left_out && crosses(edges_->start(i), edges_->end(i), point, along);
    });
    return crossed % 2 != 0;
}

}  // namespace nearfield::exact
