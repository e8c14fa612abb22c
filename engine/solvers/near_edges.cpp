#include <engine/solvers/near_edges.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Compiled once per instruction set. Without MulAdd, which rounds once on some of them and twice on
// others: the answers have the same bits on all.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solvers/near_edges.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/geometry/edge_list-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::solvers::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// A block has 64 cells: no vector is longer.
using Floats = hn::CappedTag<float, 16>;
using Words = hn::RebindToUnsigned<Floats>;
using Vector = hn::Vec<Floats>;
using Away = geometry::HWY_NAMESPACE::Away<Floats>;

constexpr std::size_t cells = std::size_t{block_side} * block_side;

/// From one edge to several points.
HWY_INLINE Away away_from_edge(const EdgeList& edges, std::size_t i, Vector x, Vector y) {
    const Floats d;
    const auto number = [&](std::size_t which) { return hn::Set(d, edges.number(which)[i]); };
    return geometry::HWY_NAMESPACE::away_from(d, number, x, y);
}

/// The columns and rows of a block's cells, row by row.
struct Offsets {
    alignas(64) std::array<float, cells> x{};
    alignas(64) std::array<float, cells> y{};

    constexpr Offsets() {
        for (std::size_t i = 0; i < cells; ++i) {
            x[i] = static_cast<float>(i % block_side);
            const std::size_t row = i / block_side;
            y[i] = static_cast<float>(row);
        }
    }
};
constexpr Offsets offsets;

/// Writes the squared distance of each cell of a block from the nearest edge. Four vectors of cells
/// go through the edges together, to hide latency.
void min_squared(const EdgeList& edges, const Block& block, float* squared) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    const auto x_of = [&](std::size_t i) {
        return hn::Add(hn::Set(d, block.x), hn::LoadU(d, offsets.x.data() + i));
    };
    const auto y_of = [&](std::size_t i) {
        return hn::Add(hn::Set(d, block.y), hn::LoadU(d, offsets.y.data() + i));
    };
    for (std::size_t first = 0; first < cells; first += 4 * lanes) {
        const Vector x0 = x_of(first);
        const Vector x1 = x_of(first + lanes);
        const Vector x2 = x_of(first + 2 * lanes);
        const Vector x3 = x_of(first + 3 * lanes);
        const Vector y0 = y_of(first);
        const Vector y1 = y_of(first + lanes);
        const Vector y2 = y_of(first + 2 * lanes);
        const Vector y3 = y_of(first + 3 * lanes);
        Vector least0 = hn::Set(d, std::numeric_limits<float>::infinity());
        Vector least1 = least0;
        Vector least2 = least0;
        Vector least3 = least0;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            least0 = hn::Min(least0, away_from_edge(edges, i, x0, y0).squared());
            least1 = hn::Min(least1, away_from_edge(edges, i, x1, y1).squared());
            least2 = hn::Min(least2, away_from_edge(edges, i, x2, y2).squared());
            least3 = hn::Min(least3, away_from_edge(edges, i, x3, y3).squared());
        }
        hn::StoreU(least0, d, squared + first);
        hn::StoreU(least1, d, squared + first + lanes);
        hn::StoreU(least2, d, squared + first + 2 * lanes);
        hn::StoreU(least3, d, squared + first + 3 * lanes);
    }
}

/// Consecutive edges in a list are usually near each other; a run has this many.
constexpr std::size_t edges_of_run = 8;

void find_runs(const EdgeList& edges, geometry::FloatArrays<3>& runs) {
    const hn::CappedTag<float, edges_of_run> d;
    runs.clear();
    for (std::size_t first = 0; first < edges.size(); first += edges_of_run) {
        const std::size_t end = std::min(first + edges_of_run, edges.size());
        const std::size_t middle = first + (end - first) / 2;
        const float x = edges.number(EdgeList::start_x)[middle];
        const float y = edges.number(EdgeList::start_y)[middle];
        auto farthest = hn::Zero(d);
        for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
            const auto number = [&](std::size_t which) {
                return hn::LoadU(d, edges.number(which) + i);
            };
            const auto start_x = hn::Sub(number(EdgeList::start_x), hn::Set(d, x));
            const auto start_y = hn::Sub(number(EdgeList::start_y), hn::Set(d, y));
            const auto end_x = hn::Add(start_x, number(EdgeList::along_x));
            const auto end_y = hn::Add(start_y, number(EdgeList::along_y));
            const auto farther =
                hn::Max(hn::Add(hn::Mul(start_x, start_x), hn::Mul(start_y, start_y)),
                        hn::Add(hn::Mul(end_x, end_x), hn::Mul(end_y, end_y)));
            farthest = hn::Max(farthest, hn::IfThenElseZero(hn::FirstN(d, end - i), farther));
        }
        runs.push({x, y, std::sqrt(hn::GetLane(hn::MaxOfLanes(d, farthest)))}, 0);
    }
}

/// Copies into `near` the edges of the runs that can contain the edge nearest to some of the
/// points, or one as near up to `margin` and single-precision rounding.
void select_runs(const EdgeList& edges, const geometry::FloatArrays<3>& runs, Vector x, Vector y,
                 float margin, EdgeList& near) {
    const Floats d;
    const auto squared_to = [&](std::size_t run) {
        const Vector off_x = hn::Sub(x, hn::Set(d, runs.number(0)[run]));
        const Vector off_y = hn::Sub(y, hn::Set(d, runs.number(1)[run]));
        return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
    };
    Vector least = squared_to(0);
    for (std::size_t run = 1; run < runs.size(); ++run) {
        least = hn::Min(least, squared_to(run));
    }
    // The vertex is no nearer than the nearest edge. Slightly increased for rounding.
    const Vector distance = hn::Sqrt(least);
    const Vector reach =
        hn::Add(hn::Mul(distance, hn::Set(d, 1.0F + 0x1p-16F)), hn::Set(d, margin + 0.01F));
    near.clear();
    for (std::size_t run = 0; run < runs.size(); ++run) {
        const Vector limit = hn::Add(reach, hn::Set(d, runs.number(2)[run]));
        if (!hn::AllFalse(d, hn::Le(squared_to(run), hn::Mul(limit, limit)))) {
            const std::size_t first = edges_of_run * run;
            near.append(edges, first, std::min(first + edges_of_run, edges.size()));
        }
    }
}

/// Also finds the edge nearest to each cell, flagged as unique if no other is as near.
void find_nearest(const EdgeList& all, const Block& block, BlockScratch& scratch, float* squared,
                  std::uint32_t* nearest) {
    // From this many edges on it pays to select those that matter to a vector of cells.
    constexpr std::size_t many_edges = 64;
    const Floats d;
    const Words words;
    bool pick = all.size() >= many_edges;
    if (pick) {
        find_runs(all, scratch.runs);
    }
    for (std::size_t first = 0; first < cells; first += hn::Lanes(d)) {
        const Vector x = hn::Add(hn::Set(d, block.x), hn::LoadU(d, offsets.x.data() + first));
        const Vector y = hn::Add(hn::Set(d, block.y), hn::LoadU(d, offsets.y.data() + first));
        if (pick) {
            select_runs(all, scratch.runs, x, y, block.margin, scratch.near);
            // Runs of spikes are long: if most of them matter, selecting costs more than it saves.
            pick = scratch.near.size() < all.size() / 2;
        }
        const EdgeList& edges = pick ? scratch.near : all;
        Vector least = hn::Set(d, std::numeric_limits<float>::infinity());
        Away best{hn::Zero(d), hn::Zero(d)};
        auto edge = hn::Zero(words);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const Away away = away_from_edge(edges, i, x, y);
            const Vector distance = away.squared();
            const auto nearer = hn::Lt(distance, least);
            least = hn::Min(least, distance);
            best.x = hn::IfThenElse(nearer, away.x, best.x);
            best.y = hn::IfThenElse(nearer, away.y, best.y);
            edge = hn::IfThenElse(hn::RebindMask(words, nearer), hn::Set(words, edges.indices()[i]),
                                  edge);
        }
        // A second point as near up to the margin is a rival if it lies farther from the first than
        // one straight wall explains (PenetratingPoint::unique); far from the boundary the margin
        // is the resolution of single precision.
        const Vector distance = hn::Sqrt(least);
        const Vector margin =
            hn::Max(hn::Set(d, block.margin), hn::Mul(distance, hn::Set(d, 0x1p-18F)));
        const Vector limit = hn::Add(distance, margin);
        const Vector along_wall = hn::Mul(margin, hn::Add(limit, distance));
        const Vector max_apart = hn::Mul(hn::Set(d, 4.0F), along_wall);
        const Vector squared_limit = hn::Mul(limit, limit);
        auto rival = hn::Lt(least, hn::Zero(d));  // none
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const Away away = away_from_edge(edges, i, x, y);
            const Away apart{hn::Sub(away.x, best.x), hn::Sub(away.y, best.y)};
            rival = hn::Or(rival, hn::And(hn::Le(away.squared(), squared_limit),
                                          hn::Gt(apart.squared(), max_apart)));
        }
        const auto flag =
            hn::IfThenZeroElse(hn::RebindMask(words, rival), hn::Set(words, nearest_unique));
        hn::StoreU(least, d, squared + first);
        hn::StoreU(hn::Or(edge, flag), words, nearest + first);
    }
}

float solve_block(const EdgeList& edges, const Block& block, BlockScratch& scratch) {
    alignas(64) std::array<float, cells> squared;
    alignas(64) std::array<std::uint32_t, cells> nearest;
    if (block.nearest == nullptr) {
        min_squared(edges, block, squared.data());
    } else {
        find_nearest(edges, block, scratch, squared.data(), nearest.data());
        for (std::size_t row = 0; row < block.rows; ++row) {
            for (std::size_t column = 0; column < block.columns; ++column) {
                const std::size_t cell = row * block_side + column;
                const bool inside = (block.inside >> cell & 1U) != 0;
                block.nearest[row * block.stride + column] =
                    nearest[cell] | (inside ? nearest_inside : 0U);
            }
        }
    }
    if (block.distances == nullptr) {
        return 0.0F;
    }
    const Floats d;
    const Vector scale = hn::Set(d, block.scale);
    for (std::size_t i = 0; i < cells; i += hn::Lanes(d)) {
        hn::StoreU(hn::Mul(hn::Sqrt(hn::LoadU(d, squared.data() + i)), scale), d,
                   squared.data() + i);
    }
    float largest = 0.0F;
    for (std::size_t row = 0; row < block.rows; ++row) {
        for (std::size_t column = 0; column < block.columns; ++column) {
            const std::size_t cell = row * block_side + column;
            const float distance = squared[cell];
            const bool inside = (block.inside >> cell & 1U) != 0;
            largest = std::max(largest, distance);
            block.distances[row * block.stride + column] = inside ? -distance : distance;
        }
    }
    return largest;
}

}  // namespace
}  // namespace nearfield::solvers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::solvers {

HWY_EXPORT(solve_block);

float select_near(const EdgeList& from, const Disc& disc, float slack, std::vector<float>& squared,
                  EdgeList& to) {
    squared.resize(std::max(squared.size(), from.capacity()));
    const float least =
        std::sqrt(geometry::measure_squared(from, 0, from.size(), disc.x, disc.y, squared.data()));
    // The edge nearest to the centre is at most one radius farther from any point of the disc; an
    // edge nearer than that to some point is at most one more radius farther from the centre.
    const float reach = least + 2.0F * disc.radius + slack + least * 0x1p-17F;
    to.clear();
    geometry::push_within(from, 0, from.size(), squared.data(), reach * reach, to);
    return least;
}

float solve_block(const EdgeList& edges, const Block& block, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(solve_block)(edges, block, scratch);
}

}  // namespace nearfield::solvers
#endif
