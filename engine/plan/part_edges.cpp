#include <engine/geometry/clip.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/plan/part_edges.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace nearfield::plan {

using geometry::Vector;

void PartEdges::find(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                     double slack) {
    width_ = width;
    height_ = height;
    find_candidates(boundary, slack);
    listed_.clear();
    parts_.assign(std::size_t{along(width)} * along(height), {});
    visit(0, 0, std::bit_ceil(std::max(along(width), along(height))), 0, candidates_.size());
}

void PartEdges::append(std::uint32_t part, std::vector<TileEdge>& edges) const {
    const auto [first, count] = parts_[part];
    for (const std::uint32_t edge : std::span(listed_).subspan(first, count)) {
        edges.push_back(near_[edge]);
    }
}

void PartEdges::find_candidates(const TileBoundary& boundary, double slack) {
    const Vector centre(0.5 * width_, 0.5 * height_);
    const double nearest = boundary.distance(centre);
    // In double precision so far. Edges are cut to a window around the tile, so that what rounding
    // to floats may change about a distance depends on it and not on how far an edge reaches.
    window_ = nearest + 2.0 * (centre.norm() + slack) + 1.0;
    slack_ = static_cast<float>(2.0 * (slack + 0.01 + 2e-6 * window_));
    near_.clear();
    candidates_.clear();
    boundary.for_edges_near(centre, window_, [&](std::uint32_t i) {
        const TileEdge edge{boundary.start(i), boundary.end(i), i};
        Vector a = edge.a - centre;
        Vector b = edge.b - centre;
        for (const int axis : {0, 1}) {
            static_cast<void>(geometry::clip_to_slab(a, b, axis, -2.0 * window_, 2.0 * window_));
        }
        const Vector d = b - a;
        const double squared = d.squaredNorm();
        candidates_.push_back({static_cast<float>(a.x()), static_cast<float>(a.y()),
                               static_cast<float>(d.x()), static_cast<float>(d.y()),
                               squared < 1e-30 ? 0.0F : static_cast<float>(1.0 / squared),
                               static_cast<std::uint32_t>(near_.size())});
        near_.push_back(edge);
    });
}

void PartEdges::visit(std::uint32_t column, std::uint32_t row, std::uint32_t count,
                      std::size_t first, std::size_t end) {
    if (column >= along(width_) || row >= along(height_)) {
        return;
    }
    const float half_width = 0.5F * static_cast<float>(width_);
    const float half_height = 0.5F * static_cast<float>(height_);
    keep(static_cast<float>(column * side) - half_width,
         static_cast<float>(row * side) - half_height,
         static_cast<float>(std::min((column + count) * side, width_)) - half_width,
         static_cast<float>(std::min((row + count) * side, height_)) - half_height, first, end);
    const std::size_t kept_end = candidates_.size();
    if (count == 1) {
        parts_[std::size_t{row} * along(width_) + column] = {listed_.size(), kept_end - end};
        for (std::size_t i = end; i < kept_end; ++i) {
            listed_.push_back(candidates_[i].edge);
        }
    } else {
        const std::uint32_t half = count / 2;
        for (const std::uint32_t dy : {0U, half}) {
            for (const std::uint32_t dx : {0U, half}) {
                visit(column + dx, row + dy, half, end, kept_end);
            }
        }
    }
    candidates_.resize(end);
}

void PartEdges::keep(float low_x, float low_y, float high_x, float high_y, std::size_t first,
                     std::size_t end) {
    const float x = 0.5F * (low_x + high_x);
    const float y = 0.5F * (low_y + high_y);
    const float hx = high_x - x;
    const float hy = high_y - y;
    away_x_.resize(std::max(away_x_.size(), end));
    away_y_.resize(std::max(away_y_.size(), end));
    squared_.resize(std::max(squared_.size(), end));
    std::size_t best = first;
    for (std::size_t i = first; i < end; ++i) {
        const Candidate& edge = candidates_[i];
        const float px = x - edge.ax;
        const float py = y - edge.ay;
        const float t = (px * edge.dx + py * edge.dy) * edge.inverse_squared_length;
        const float clamped = std::min(std::max(t, 0.0F), 1.0F);
        away_x_[i] = px - clamped * edge.dx;
        away_y_[i] = py - clamped * edge.dy;
        squared_[i] = away_x_[i] * away_x_[i] + away_y_[i] * away_y_[i];
        best = squared_[i] < squared_[best] ? i : best;
    }

    // From the corners to the edge nearest to the centre, and that much more.
    const Candidate nearest = candidates_[best];
    const auto at_corner = [&](float sign_x, float sign_y) {
        const float px = x + sign_x * hx - nearest.ax;
        const float py = y + sign_y * hy - nearest.ay;
        const float t = (px * nearest.dx + py * nearest.dy) * nearest.inverse_squared_length;
        const float clamped = std::min(std::max(t, 0.0F), 1.0F);
        const float ex = px - clamped * nearest.dx;
        const float ey = py - clamped * nearest.dy;
        return std::sqrt(ex * ex + ey * ey) + slack_;
    };
    const float low_left = at_corner(-1.0F, -1.0F);
    const float low_right = at_corner(1.0F, -1.0F);
    const float high_left = at_corner(-1.0F, 1.0F);
    const float high_right = at_corner(1.0F, 1.0F);
    for (std::size_t i = first; i < end; ++i) {
        const float distance = std::sqrt(squared_[i]);
        const float inverse = distance > 0.0F ? 1.0F / distance : 0.0F;
        const float slope_x = away_x_[i] * inverse * hx;
        const float slope_y = away_y_[i] * inverse * hy;
        if (distance - slope_x - slope_y <= low_left || distance + slope_x - slope_y <= low_right ||
            distance - slope_x + slope_y <= high_left ||
            distance + slope_x + slope_y <= high_right) {
            const Candidate kept = candidates_[i];
            candidates_.push_back(kept);
        }
    }
}

}  // namespace nearfield::plan
