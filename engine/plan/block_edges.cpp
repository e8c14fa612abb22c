#include <engine/base/interruption.hpp>
#include <engine/geometry/quarters.hpp>
#include <engine/plan/block_edges.hpp>

#include <algorithm>
#include <bit>

namespace nearfield::plan {
namespace {

using geometry::Vector;

/// Up to this many edges are tested at every cell instead of being culled further.
constexpr std::size_t few_edges = 2;

}  // namespace

void BlockEdges::find(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                      double slack) {
    width_ = width;
    height_ = height;
    find_candidates(boundary, slack);
    listed_.clear();
    blocks_.assign(std::size_t{along(width)} * along(height), {});
    visit(0, 0, std::bit_ceil(std::max(along(width), along(height))), 0, candidates_.size());
}

void BlockEdges::append(std::uint32_t block, std::vector<TileEdge>& edges) const {
    const auto [first, count] = blocks_[block];
    for (std::size_t i = first; i < first + count; ++i) {
        edges.push_back(near_[listed_.indices()[i]]);
    }
}

void BlockEdges::append(std::uint32_t block, std::vector<SegmentData>& segments) const {
    const auto [first, count] = blocks_[block];
    const std::uint32_t column = block % along(width_) * block_side;
    const std::uint32_t row = block / along(width_) * block_side;
    const float x = 0.5F * static_cast<float>(width_) - static_cast<float>(column);
    const float y = 0.5F * static_cast<float>(height_) - static_cast<float>(row);
    const float* start_x = listed_.number(EdgeStack::start_x) + first;
    const float* start_y = listed_.number(EdgeStack::start_y) + first;
    const float* along_x = listed_.number(EdgeStack::along_x) + first;
    const float* along_y = listed_.number(EdgeStack::along_y) + first;
    const std::size_t before = segments.size();
    segments.resize(before + count);
    SegmentData* const added = segments.data() + before;
    for (std::size_t i = 0; i < count; ++i) {
        const float half_x = 0.5F * along_x[i];
        const float half_y = 0.5F * along_y[i];
        added[i] = {{start_x[i] + x + half_x, start_y[i] + y + half_y}, {half_x, half_y}};
    }
}

void BlockEdges::find_candidates(const TileBoundary& boundary, double slack) {
    const Vector centre(0.5 * width_, 0.5 * height_);
    const double nearest = boundary.distance(centre);
    // Double precision up to here.
    window_ = nearest + 2.0 * (centre.norm() + slack) + 1.0;
    slack_ = static_cast<float>(2.0 * (slack + 0.01 + 2e-6 * window_));
    near_.clear();
    candidates_.clear();
    boundary.for_edges_near(centre, window_, [&](std::uint32_t i) {
        const TileEdge edge{boundary.start(i), boundary.end(i), i};
        static_cast<void>(push_part(edge.a - centre, edge.b - centre, window_,
                                    static_cast<std::uint32_t>(near_.size()), candidates_));
        near_.push_back(edge);
    });
}

EdgeNode BlockEdges::node(std::uint32_t column, std::uint32_t row, std::uint32_t count) const {
    const auto low_x = static_cast<float>(column * block_side);
    const auto low_y = static_cast<float>(row * block_side);
    const auto high_x = static_cast<float>(std::min((column + count) * block_side, width_));
    const auto high_y = static_cast<float>(std::min((row + count) * block_side, height_));
    return {0.5F * (low_x + high_x - static_cast<float>(width_)),
            0.5F * (low_y + high_y - static_cast<float>(height_)), 0.5F * (high_x - low_x),
            0.5F * (high_y - low_y)};
}

void BlockEdges::visit(std::uint32_t column, std::uint32_t row, std::uint32_t count,
                       std::size_t first, std::size_t end) {
    if (column >= along(width_) || row >= along(height_)) {
        return;
    }
    checkpoint_.step();
    const std::size_t before = candidates_.size();
    if (end - first > few_edges) {
        push_near(candidates_, first, end, node(column, row, count), slack_);
        first = before;
        end = candidates_.size();
    }
    if (count == 1) {
        blocks_[std::size_t{row} * along(width_) + column] = {listed_.size(), end - first};
        listed_.append(candidates_, first, end);
    } else {
        const std::uint32_t half = count / 2;
        geometry::for_quarters(column, row, half,
                               [&](std::uint32_t quarter_x, std::uint32_t quarter_y) {
                                   visit(quarter_x, quarter_y, half, first, end);
                               });
    }
    candidates_.resize(before);
}

}  // namespace nearfield::plan
