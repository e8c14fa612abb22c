#include <engine/base/interruption.hpp>
#include <engine/geometry/clip.hpp>
#include <engine/geometry/quarters.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/raster/nearest_edges.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace nearfield::raster {

using geometry::EdgeList;
using geometry::Vector;

namespace {

/// Pushes the part of an edge that lies within `window` of the origin along both axes, so that the
/// rounding error of a distance in floats depends on the window and not on how far the edge
/// reaches. Along an axis where it lies wholly beyond the window, an edge is not cut. Returns the
/// squared length of the part, 0 for an edge of no length.
double push_part(Vector start, Vector end, double window, std::uint32_t index, EdgeList& edges) {
    for (const int axis : {0, 1}) {
        static_cast<void>(geometry::clip_to_slab(start, end, axis, -window, window));
    }
    return push_edge(start, end, index, edges);
}

}  // namespace

void NearestEdgeFinder::find(const queries::TileBoundary& boundary,
                             const device_input::NeededBlocks& needed, double slack,
                             std::vector<NearestEdge>& result) {
    result.clear();
    needed_ = &needed;
    find_candidates(boundary, slack);
    reach_left_.assign(near_.size(), 0.0);
    reach_right_.assign(near_.size(), 0.0);
    const std::uint32_t blocks =
        (std::max(needed.width(), needed.height()) + needed.side() - 1) / needed.side();
    visit(0, 0, std::bit_ceil(blocks), 0, candidates_.size());

    for (std::size_t i = 0; i < near_.size(); ++i) {
        if (reach_left_[i] > 0.0 || reach_right_[i] > 0.0) {
            result.push_back({near_[i], reach_left_[i], reach_right_[i]});
        }
    }
}

void NearestEdgeFinder::find_candidates(const queries::TileBoundary& boundary, double slack) {
    const Vector centre(0.5 * needed_->width(), 0.5 * needed_->height());
    const double nearest = boundary.distance(centre);
    // Double precision up to here. Everything relevant lies within a window around the tile. Edges
    // are cut to the window, so that the rounding error of a distance in floats, which is added to
    // the slack, depends on the window and not on how far an edge reaches.
    const double window = nearest + 2.0 * (centre.norm() + slack) + 1.0;
    slack_ = slack + 0.01 + 1e-6 * window;
    const double limit = nearest + 2.0 * (centre.norm() + slack_);
    near_.clear();
    candidates_.clear();
    inverse_length_.clear();
    boundary.for_edges_near(centre, limit, [&](std::uint32_t i) {
        const queries::TileEdge edge{boundary.start(i), boundary.end(i), i};
        if (std::sqrt(geometry::nearest_on_segment(centre, edge.a, edge.b).squared_distance) >
            limit) {
            return;
        }
        const double squared = push_part(edge.a - centre, edge.b - centre, 2.0 * window,
                                         static_cast<std::uint32_t>(near_.size()), candidates_);
        near_.push_back(edge);
        inverse_length_.push_back(squared == 0.0 ? 0.0F
                                                 : static_cast<float>(1.0 / std::sqrt(squared)));
    });
}

void NearestEdgeFinder::visit(std::uint32_t column, std::uint32_t row, std::uint32_t count,
                              std::size_t first, std::size_t end) {
    checkpoint();
    if (!needed_->any(column, row, count)) {
        return;
    }
    // The part of the tile that these blocks cover.
    const std::uint32_t side = needed_->side();
    const Vector low(column * side, row * side);
    const Vector high(std::min((column + count) * side, needed_->width()),
                      std::min((row + count) * side, needed_->height()));
    const Vector tile_centre(0.5 * needed_->width(), 0.5 * needed_->height());
    const Vector centre = 0.5 * (low + high) - tile_centre;
    const double half_diagonal = 0.5 * (high - low).norm();
    const auto x = static_cast<float>(centre.x());
    const auto y = static_cast<float>(centre.y());

    squared_.resize(std::max(squared_.size(), candidates_.capacity()));
    const float nearest = measure_squared(candidates_, first, end, x, y, squared_.data());
    const double distance = std::sqrt(static_cast<double>(nearest));
    const double limit = distance + 2.0 * (half_diagonal + slack_);
    // Far from the boundary, finer blocks gain little.
    if (count == 1 || half_diagonal < distance / 8.0) {
        reach_out(first, end, x, y, limit, half_diagonal, distance + half_diagonal + slack_);
        return;
    }
    push_within(candidates_, first, end, squared_.data(), static_cast<float>(limit * limit),
                candidates_);
    const std::size_t kept_end = candidates_.size();
    const std::uint32_t half = count / 2;
    geometry::for_quarters(column, row, half,
                           [&](std::uint32_t quarter_x, std::uint32_t quarter_y) {
                               visit(quarter_x, quarter_y, half, end, kept_end);
                           });
    candidates_.resize(end);
}

void NearestEdgeFinder::reach_out(std::size_t first, std::size_t end, float x, float y,
                                  double limit, double half_diagonal, double reach) {
    push_within(candidates_, first, end, squared_.data(), static_cast<float>(limit * limit),
                candidates_);
    const auto wide = static_cast<float>(half_diagonal + slack_);
    // Without branches: no processor can predict the side.
    for (std::size_t i = end; i < candidates_.size(); ++i) {
        const std::uint32_t index = candidates_.indices()[i];
        // Distance of the centre to the left of the edge's line; an edge of no length has no side.
        const float left = (candidates_.number(EdgeList::along_x)[i] *
                                (y - candidates_.number(EdgeList::start_y)[i]) -
                            candidates_.number(EdgeList::along_y)[i] *
                                (x - candidates_.number(EdgeList::start_x)[i])) *
                           inverse_length_[index];
        reach_left_[index] = std::max(reach_left_[index], left > -wide ? reach : 0.0);
        reach_right_[index] = std::max(reach_right_[index], left < wide ? reach : 0.0);
    }
    candidates_.resize(end);
}

}  // namespace nearfield::raster
