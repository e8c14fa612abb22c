#include <engine/narrowphase/boundary.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::narrowphase {

using geometry::Vector;

void Boundary::set(const simd::TransformedEdges& edges) {
    edges_ = &edges;
    tree_.emplace(edges.tree());
    parities_.begin(*tree_);
    if (near_.size() < simd::padded(edges.count)) {
        near_.resize(simd::padded(edges.count));
    }
}

void Boundary::set(const geometry::TransformedPolygon& polygon) {
    own_.place_alone(polygon);
    own_.complete(0);
    set(own_[0]);
}

NearestPoint Boundary::nearest(const Vector& point, std::uint32_t first_guess) const {
    const simd::NearEdge guess{first_guess, nearest_on(first_guess, point).squared_distance};
    const std::uint32_t edge = simd::kernels::find_nearer(*tree_, point.x(), point.y(), guess).edge;
    return {edge, nearest_on(edge, point)};
}

std::uint32_t Boundary::keep_inside(std::uint32_t count, const simd::FoundPoints& points) {
    // If no edge's box intersects the box of these points, they all lie on one side. The previous
    // point, added to the box, determines which.
    constexpr std::uint32_t together = 8;
    RayParities::Ticket inside = RayParities::even;
    Vector last;
    tickets_.clear();
    for (std::uint32_t first = 0; first < count; first += together) {
        const std::uint32_t end = std::min(first + together, count);
        geometry::Box box;
        for (std::uint32_t i = first; i < end; ++i) {
            box.extend(Vector(points.x[i], points.y[i]));
        }
        bool on_one_side = false;
        if (first > 0) {
            box.extend(last);
            on_one_side = !simd::kernels::meets(*tree_, geometry::extent_of(box));
        }
        for (std::uint32_t i = first; i < end; ++i) {
            last = {points.x[i], points.y[i]};
            inside = on_one_side ? inside : parities_.ask(last.x(), last.y());
            tickets_.push_back(inside);
        }
    }
    parities_.answer();
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        points.x[kept] = points.x[i];
        points.y[kept] = points.y[i];
        kept += parities_.is_odd(tickets_[i]) ? 1U : 0U;
    }
    return kept;
}

bool Boundary::is_unique(const Vector& point, const NearestPoint& nearest, double margin) {
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin;
    // Skips edges that are clearly farther away.
    const std::uint32_t count = simd::kernels::find_edges_within(
        *tree_, point.x(), point.y(), simd::beyond_rounding(limit), near_.data());
    if (count <= 1) {
        return true;  // only the nearest
    }
    return std::none_of(near_.begin(), near_.begin() + count, [&](std::uint32_t edge) {
        return is_rival(nearest_on(edge, point), nearest.on_edge, limit);
    });
}

AskedNormal Boundary::ask_outward_normal(std::uint32_t edge, double parameter) {
    const Vector start = edges_->start(edge);
    const Vector direction = edges_->end(edge) - start;
    const double length = direction.norm();
    if (length == 0.0) {
        return {};
    }
    const Vector left(-direction.y() / length, direction.x() / length);
    // The ray leaves the edge across its longer extent; the side just off the edge decides.
    const bool upwards = std::abs(direction.y()) < std::abs(direction.x());
    // At an end, a neighbour is as near: the side is tested a little beside it.
    const double margin = std::clamp(16.0 * edges_->rounding / length, 0x1p-20, 0.25);
    const Vector point = start + std::clamp(parameter, margin, 1.0 - margin) * direction;
    return {left, left[upwards ? 1 : 0] > 0.0,
            parities_.ask({point.x(), point.y(), upwards},
                          {direction.x(), direction.y(), edges_->rounding})};
}

}  // namespace nearfield::narrowphase
