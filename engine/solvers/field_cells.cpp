#include <engine/base/interruption.hpp>
#include <engine/geometry/clip.hpp>
#include <engine/geometry/quarters.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/solvers/coverage.hpp>
#include <engine/solvers/field_cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nearfield::solvers {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

namespace {

/// The side of the squares whose edges have their own local coordinates: one word of signs.
constexpr std::uint64_t near_side = 64;

/// At most this many edges are tested at every cell without further culling.
constexpr std::uint32_t few_edges = 6;

/// Calls `use(start, end)` for every edge, with the indices of its vertices.
template <class Use>
void for_own_edges(const Polygon& shape, const Use& use) {
    for (std::uint32_t ring = 0; ring < shape.ring_count(); ++ring) {
        std::uint32_t start = shape.ring_begin(ring);
        for (; start + 1 < shape.ring_end(ring); ++start) {
            use(start, start + 1);
        }
        use(start, shape.ring_begin(ring));
    }
}

}  // namespace

double CellSolver::solve(const TransformedPolygon& polygon,
                         std::span<const geometry::SimplifiedEdge> simplified,
                         const FieldGrid& grid, const FieldOutput& output) {
    grid_ = grid;
    output_ = output;
    largest_ = 0.0;
    place(polygon, simplified);
    find_signs(polygon.polygon());
    make_far_list();
    Square root{0, 0, near_side};
    while (root.side < std::max(grid.width, grid.height)) {
        root.side *= 2;
    }
    divide(root, 0);
    return largest_;
}

void CellSolver::place(const TransformedPolygon& polygon,
                       std::span<const geometry::SimplifiedEdge> simplified) {
    const Polygon& shape = polygon.polygon();
    const Eigen::Matrix2d matrix = polygon.rotation() / grid_.cell;
    const Vector offset = (polygon.translation() - grid_.origin) / grid_.cell;
    vertices_.clear();
    for (const Vector& vertex : shape.vertices()) {
        vertices_.push_back(matrix.col(0) * vertex.x() + matrix.col(1) * vertex.y() + offset);
    }
    edges_.clear();
    for (const geometry::SimplifiedEdge& edge : simplified) {
        edges_.push_back({vertices_[edge.first], vertices_[edge.last]});
    }
    if (simplified.empty()) {
        for_own_edges(shape, [this](std::uint32_t start, std::uint32_t end) {
            edges_.push_back({vertices_[start], vertices_[end]});
        });
    }
}

void CellSolver::find_signs(const Polygon& shape) {
    words_per_row_ = (grid_.width + near_side - 1) / near_side;
    inside_.assign(words_per_row_ * grid_.height, 0);
    for_own_edges(shape, [this](std::uint32_t start, std::uint32_t end) {
        checkpoint_.step();
        add_crossings(vertices_[start], vertices_[end]);
    });
    for (std::size_t row = 0; row < grid_.height; ++row) {
        fill_from_crossings(std::span(inside_).subspan(row * words_per_row_, words_per_row_));
    }
}

void CellSolver::add_crossings(const Vector& start, const Vector& end) {
    if (start.y() == end.y() || std::max(start.x(), end.x()) <= 0.5) {
        return;
    }
    // Half open, so that a vertex level with a row of centres belongs to one of its two edges.
    const auto row_from = [&](double y) {
        return static_cast<std::size_t>(
            std::clamp(std::ceil(y - 0.5), 0.0, static_cast<double>(grid_.height)));
    };
    const std::size_t last_row = row_from(std::max(start.y(), end.y()));
    const double slope = (end.x() - start.x()) / (end.y() - start.y());
    for (std::size_t row = row_from(std::min(start.y(), end.y())); row < last_row; ++row) {
        const double x = start.x() + (static_cast<double>(row) + 0.5 - start.y()) * slope;
        // The number of centres left of the edge.
        const double left = std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(grid_.width));
        if (left > 0.0) {
            const std::size_t last = static_cast<std::size_t>(left) - 1;
            inside_[row * words_per_row_ + last / near_side] ^= std::uint64_t{1}
                                                                << (last % near_side);
        }
    }
}

void CellSolver::make_far_list() {
    // Two lists for each depth of the quadtree down to blocks: candidate edges in, near edges out.
    std::size_t depths = 3;
    for (std::uint64_t side = block_side; side < std::max(grid_.width, grid_.height) + near_side;
         side *= 2) {
        ++depths;
    }
    levels_.resize(std::max(levels_.size(), depths));
    far_origin_ = 0.5 * Vector(grid_.width, grid_.height);
    EdgeList& all = levels_[0];
    all.clear();
    all.reserve(edges_.size());
    double farthest = far_origin_.maxCoeff();
    for (const Ends& edge : edges_) {
        const Vector start = edge.start - far_origin_;
        farthest = std::max(farthest, start.cwiseAbs().maxCoeff());
        push_edge(start, edge.end - far_origin_, static_cast<std::uint32_t>(all.size()), all);
    }
    far_slack_ = std::ldexp(farthest, -18);
}

template <class Use>
void CellSolver::for_quarters(const Square& square, const Use& use) const {
    const auto half = square.side / 2;
    geometry::for_quarters(square.column, square.row, half, [&](auto column, auto row) {
        if (column < grid_.width && row < grid_.height) {
            use(Square{column, row, half});
        }
    });
}

CellSolver::Extent CellSolver::extent(const Square& square) const {
    return {static_cast<double>(std::min(square.side, grid_.width - square.column)),
            static_cast<double>(std::min(square.side, grid_.height - square.row))};
}

Disc CellSolver::disc(const Square& square, const Vector& origin) const {
    const Extent size = extent(square);
    return {static_cast<float>(static_cast<double>(square.column) + 0.5 * size.width - origin.x()),
            static_cast<float>(static_cast<double>(square.row) + 0.5 * size.height - origin.y()),
            static_cast<float>(0.5 * Vector(size.width - 1.0, size.height - 1.0).norm())};
}

void CellSolver::divide(const Square& square, std::size_t depth) {
    checkpoint();
    const Disc cells = disc(square, far_origin_);
    const auto slack = static_cast<float>(output_.margin + 0.01 + 4.0 * far_slack_);
    const auto nearest = static_cast<double>(
        select_near(levels_[depth], cells, slack, squared_, levels_[depth + 1]));
    if (square.side > near_side) {
        for_quarters(square, [&](const Square& quarter) { divide(quarter, depth + 1); });
        return;
    }
    make_near_list(square, levels_[depth + 1], nearest, levels_[depth + 2]);
    divide_near(square, depth + 2);
}

void CellSolver::make_near_list(const Square& square, const EdgeList& far, double nearest,
                                EdgeList& near) {
    const Extent size = extent(square);
    near_origin_ = {static_cast<double>(square.column) + 0.5 * size.width,
                    static_cast<double>(square.row) + 0.5 * size.height};
    if (far_slack_ > 0.0625) {
        // Single precision resolves little of the edges' distance for a shape this large.
        nearest = distance_from(near_origin_, far);
    }
    // An edge that can be nearest to a cell, or as near as the nearest, is no farther from it than
    // this; far ends are cut off in double precision. The remaining coordinates are small.
    const double reach = nearest * (1.0 + 0x1p-16) + Vector(size.width, size.height).norm() / 2.0 +
                         output_.margin + 1.0;
    const double across = 0.5 * size.width + reach;
    const double up = 0.5 * size.height + reach;
    near.clear();
    near.reserve(far.size());
    for (std::uint32_t i = 0; i < far.size(); ++i) {
        const std::uint32_t edge = far.indices()[i];
        Vector start = edges_[edge].start - near_origin_;
        Vector end = edges_[edge].end - near_origin_;
        if (geometry::clip_to_slab(start, end, 0, -across, across) &&
            geometry::clip_to_slab(start, end, 1, -up, up)) {
            push_edge(start, end, edge, near);
        }
    }
}

double CellSolver::distance_from(const Vector& point, const EdgeList& edges) const {
    double squared = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const Ends& edge = edges_[edges.indices()[i]];
        squared = std::min(
            squared, geometry::nearest_on_segment(point, edge.start, edge.end).squared_distance);
    }
    return std::sqrt(squared);
}

void CellSolver::divide_near(const Square& square, std::size_t depth) {
    checkpoint_.step();
    const EdgeList& edges = levels_[depth];
    if (square.side == block_side) {
        solve_block_at(square, edges);
        return;
    }
    const bool sort_out = edges.size() > few_edges;
    for_quarters(square, [&](const Square& quarter) {
        if (sort_out) {
            select_near(levels_[depth], disc(quarter, near_origin_),
                        static_cast<float>(output_.margin + 0.01), squared_, levels_[depth + 1]);
        }
        divide_near(quarter, sort_out ? depth + 1 : depth);
    });
}

void CellSolver::solve_block_at(const Square& square, const EdgeList& edges) {
    Block block;
    block.x = static_cast<float>(static_cast<double>(square.column) + 0.5 - near_origin_.x());
    block.y = static_cast<float>(static_cast<double>(square.row) + 0.5 - near_origin_.y());
    const Extent size = extent(square);
    block.columns = static_cast<std::uint32_t>(size.width);
    block.rows = static_cast<std::uint32_t>(size.height);
    for (std::uint64_t row = 0; row < block.rows; ++row) {
        const std::uint64_t word =
            inside_[(square.row + row) * words_per_row_ + square.column / near_side];
        block.inside |= (word >> square.column % near_side & 0xffU) << (block_side * row);
    }
    block.scale = static_cast<float>(output_.scale);
    const std::size_t first = square.row * grid_.width + square.column;
    block.distances = output_.distances.empty() ? nullptr : output_.distances.data() + first;
    block.nearest = output_.nearest.empty() ? nullptr : output_.nearest.data() + first;
    block.stride = grid_.width;
    block.margin = static_cast<float>(output_.margin);
    largest_ = std::max(largest_, static_cast<double>(solve_block(edges, block, scratch_)));
}

}  // namespace nearfield::solvers
