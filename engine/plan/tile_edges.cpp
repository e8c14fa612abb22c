#include <engine/plan/tile_edges.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <engine/geometry/segment.hpp>

namespace nearfield::plan {

using geometry::Vector;

void TileBoundary::place(const geometry::Polygon& shape,
                         const std::vector<geometry::SimplifiedEdge>& simplified,
                         const ToCells& to_cells) {
    polygon = &shape;
    edges = &simplified;
    const auto count = static_cast<std::uint32_t>(simplified.size());
    starts.resize(count);
    next.resize(count);
    previous.resize(count);
    std::uint32_t ring_start = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        starts[i] = to_cells(shape.vertices()[simplified[i].first]);
        // A ring's last edge ends where its first one starts.
        const bool closes = simplified[i].last == simplified[ring_start].first;
        next[i] = closes ? ring_start : i + 1;
        previous[next[i]] = i;
        if (closes) {
            ring_start = i + 1;
        }
    }
}

namespace {

/// Appends an edge that starts or ends left of `right`. What of an edge that may be cut lies right
/// of it is replaced by an upright edge in the same rows, so that no coordinate grows large.
void push_upright_beyond(double right, const TileEdge& edge, bool may_be_cut,
                         std::vector<TileEdge>& edges) {
    if (!may_be_cut || std::max(edge.a.x(), edge.b.x()) <= right) {
        edges.push_back(edge);
        return;
    }
    const double t = (right - edge.a.x()) / (edge.b.x() - edge.a.x());
    const Vector cut(right, edge.a.y() + t * (edge.b.y() - edge.a.y()));
    if (edge.a.x() <= right) {
        edges.push_back({edge.a, cut, edge.simplified});
        edges.push_back({cut, Vector(right, edge.b.y()), no_simplified});
    } else {
        edges.push_back({Vector(right, edge.a.y()), cut, no_simplified});
        edges.push_back({cut, edge.b, edge.simplified});
    }
}

}  // namespace

void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges) {
    const double left = -1.0 - slack;
    const double right = width + 1.0 + slack;
    const double low = -1.0 - slack;
    const double high = height + 1.0 + slack;
    const std::uint32_t count = boundary.size();
    std::uint32_t i = 0;
    while (i < count) {
        const Vector& a = boundary.start(i);
        const Vector& b = boundary.end(i);
        if (std::max(a.y(), b.y()) < low || std::min(a.y(), b.y()) > high ||
            std::max(a.x(), b.x()) < left) {
            ++i;
            continue;
        }
        if (std::min(a.x(), b.x()) <= right) {
            push_upright_beyond(right, {a, b, i}, (*boundary.edges)[i].count == 1, edges);
            ++i;
            continue;
        }
        // Join the chain that stays right of the tile, up to the end of its ring.
        std::uint32_t last = i;
        while (boundary.next[last] == last + 1 && boundary.end(last + 1).x() > right) {
            ++last;
        }
        const Vector chain_start(right, a.y());
        const Vector chain_end(right, boundary.end(last).y());
        if (chain_start.y() != chain_end.y()) {
            edges.push_back({chain_start, chain_end, no_simplified});
        }
        i = last + 1;
    }
}

void NearestEdges::clear() {
    edges.clear();
    reach.clear();
    largest_reach = 0.0;
}

void NearestEdgeFinder::keep_candidates(const TileBoundary& boundary,
                                        const std::vector<NeededBlock>& blocks, double slack) {
    geometry::Box needed;
    for (const NeededBlock& block : blocks) {
        needed.extend(block.centre);
    }
    const Vector centre = needed.center();
    double radius = 0.0;
    for (const NeededBlock& block : blocks) {
        radius = std::max(radius, (block.centre - centre).norm() + block.half_diagonal);
    }
    squared_.resize(boundary.size());
    float nearest = std::numeric_limits<float>::max();
    for (std::uint32_t i = 0; i < boundary.size(); ++i) {
        squared_[i] = static_cast<float>(
            geometry::nearest_on_segment(centre, boundary.start(i), boundary.end(i))
                .squared_distance);
        nearest = std::min(nearest, squared_[i]);
    }
    const double limit = std::sqrt(double{nearest}) + 2.0 * (radius + slack);
    const auto squared_limit = static_cast<float>(limit * limit * (1.0 + 1e-6));
    candidates_.clear();
    for (std::uint32_t i = 0; i < boundary.size(); ++i) {
        if (squared_[i] <= squared_limit) {
            candidates_.push_back(i);
        }
    }
}

void NearestEdgeFinder::find(const TileBoundary& boundary, const std::vector<NeededBlock>& blocks,
                             double slack, NearestEdges& result) {
    result.clear();
    if (blocks.empty()) {
        return;
    }
    keep_candidates(boundary, blocks, slack);

    const std::size_t count = candidates_.size();
    ax_.resize(count);
    ay_.resize(count);
    dx_.resize(count);
    dy_.resize(count);
    inverse_length_.resize(count);
    double extent = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vector a = boundary.start(candidates_[i]) - blocks.front().centre;
        const Vector d = boundary.end(candidates_[i]) - boundary.start(candidates_[i]);
        extent = std::max(extent, a.cwiseAbs().maxCoeff() + d.cwiseAbs().maxCoeff());
        ax_[i] = static_cast<float>(a.x());
        ay_[i] = static_cast<float>(a.y());
        dx_[i] = static_cast<float>(d.x());
        dy_[i] = static_cast<float>(d.y());
        const auto squared = static_cast<float>(d.squaredNorm());
        inverse_length_[i] = squared > 0.0F ? 1.0F / squared : 0.0F;
    }
    reach_.assign(count, -1.0);
    squared_.resize(count);
    for (const NeededBlock& block : blocks) {
        // Plain arrays of floats, so that the compiler vectorises: this loop is where planning
        // spends its time. What rounding may add is granted below.
        const Vector centre = block.centre - blocks.front().centre;
        const auto x = static_cast<float>(centre.x());
        const auto y = static_cast<float>(centre.y());
        float nearest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < count; ++i) {
            const float px = x - ax_[i];
            const float py = y - ay_[i];
            const float t = (px * dx_[i] + py * dy_[i]) * inverse_length_[i];
            const float clamped = std::min(std::max(t, 0.0F), 1.0F);
            const float ex = px - clamped * dx_[i];
            const float ey = py - clamped * dy_[i];
            squared_[i] = ex * ex + ey * ey;
            nearest = std::min(nearest, squared_[i]);
        }
        const double distance = std::sqrt(double{nearest});
        const double rounding = 0.01 + 1e-6 * extent;
        const double reach = distance + block.half_diagonal + slack + rounding;
        const double limit = distance + 2.0 * (block.half_diagonal + slack + rounding);
        const auto squared_limit = static_cast<float>(limit * limit);
        for (std::size_t i = 0; i < count; ++i) {
            if (squared_[i] <= squared_limit) {
                reach_[i] = std::max(reach_[i], reach);
            }
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (reach_[i] >= 0.0) {
            const std::uint32_t edge = candidates_[i];
            result.edges.push_back({boundary.start(edge), boundary.end(edge), edge});
            result.reach.push_back(reach_[i]);
            result.largest_reach = std::max(result.largest_reach, reach_[i]);
        }
    }
}

}  // namespace nearfield::plan
