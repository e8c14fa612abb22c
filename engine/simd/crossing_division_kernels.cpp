#include <engine/base/interruption.hpp>
#include <engine/simd/crossing_kernels.hpp>

#include <algorithm>
#include <cmath>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/crossing_division_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/left_out_edges-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// What is left of the edges for the rays from a box.
struct EdgesLeft {
    const std::uint32_t* edges = nullptr;  ///< whose position is undecided
    std::uint32_t edge_count = 0;
    /// Of the others, the heights at which a chain of them begins or ends: rays below it cross.
    const double* heights = nullptr;
    std::uint32_t height_count = 0;
    std::uint32_t crossed = 0;  ///< odd if every ray crosses another odd number of chains
};

/// Where an edge lies for all rays from a box that are level with it.
enum class Position : std::uint8_t { ahead, behind, undecided };

/// Tells on which side of edges a box lies, as far as rounding allows.
class SideOfLines {
public:
    /// Edges within `reach` are not decided.
    SideOfLines(const Extent& box, double reach)
        : box_(box),
          reach_(reach),
          x_(0.5 * (box.low_x + box.high_x)),
          y_(0.5 * (box.low_y + box.high_y)),
          half_x_(0.5 * (box.high_x - box.low_x) + 2.0 * reach),
          half_y_(0.5 * (box.high_y - box.low_y) + 2.0 * reach) {}

    [[nodiscard]] Position Of(double start_x, double start_y, double end_x, double end_y) const {
        if (std::max(start_x, end_x) < box_.low_x) {
            return Position::behind;
        }
        if (std::min(start_x, end_x) > box_.high_x + reach_) {
            return Position::ahead;
        }
        // Far above the rounding of what is compared.
        constexpr double relative = 1e-13;
        const double x = end_x - start_x;
        const double y = end_y - start_y;
        const double left = x * (y_ - start_y) - y * (x_ - start_x);
        const double across =
            std::abs(x) * (half_y_ + relative * (std::abs(y_) + std::abs(start_y))) +
            std::abs(y) * (half_x_ + relative * (std::abs(x_) + std::abs(start_x)));
        if (!(std::abs(left) > (1.0 + relative) * across)) {
            return Position::undecided;
        }
        // An upward edge lies ahead of what is to its left.
        return (left > 0.0) == (y > 0.0) ? Position::ahead : Position::behind;
    }

private:
    const Extent& box_;
    double reach_;
    double x_;  // of the box's centre
    double y_;
    double half_x_;
    double half_y_;
};

/// The crossings of many rays in one direction among edges that boxes do not tell apart: halves the
/// rays' starts again and again. Of chains of edges that lie ahead of all starts only the ends
/// matter, as for whole boxes.
template <bool upwards>
class CrossingsByDivision {
public:
    HWY_INLINE CrossingsByDivision(const EdgeArrays& edges, const Rays& rays,
                                   DivisionMemory& memory, std::uint8_t* odd)
        : edges_(turned<upwards>(edges)),
          rays_(rays),
          x_(upwards ? rays.y : rays.x),
          y_(upwards ? rays.x : rays.y),
          along_x_(upwards ? rays.along_y : rays.along_x),
          along_y_(upwards ? rays.along_x : rays.along_y),
          reach_(rays.along_x == nullptr ? 0.0 : 4.0 * rays.rounding),
          memory_(memory),
          odd_(odd) {}

    void Solve() {
        std::uint32_t* const chosen = memory_.list(0, rays_.count);
        std::uint32_t* const all = memory_.list(1, edges_.count);
        for (std::uint32_t i = 0; i < rays_.count; ++i) {
            chosen[i] = i;
        }
        for (std::uint32_t i = 0; i < edges_.count; ++i) {
            all[i] = i;
        }
        Divide(chosen, rays_.count, {all, edges_.count}, 2);
    }

private:
    void Divide(std::uint32_t* chosen, std::uint32_t count, const EdgesLeft& before,
                std::uint32_t depth) {
        checkpoint_.step();
        const Extent box = extent_of_points(x_, y_, chosen, count);
        const EdgesLeft left = Narrow(box, before, depth);
        if (count <= max_lanes || left.edge_count + left.height_count == 0) {
            for (std::uint32_t i = 0; i < count; i += max_lanes) {
                SolveGroup(chosen + i, std::min<std::uint32_t>(count - i, max_lanes), left);
            }
            return;
        }
        const std::uint32_t half = halve(x_, y_, box, chosen, count);
        Divide(chosen, half, left, depth + 1);
        Divide(chosen + half, count - half, left, depth + 1);
    }

    /// What is left for the rays from a box within that of `before`.
    [[nodiscard]] EdgesLeft Narrow(const Extent& box, const EdgesLeft& before,
                                   std::uint32_t depth) const {
        std::uint32_t* const listed = memory_.list(depth, before.edge_count);
        double* const heights =
            memory_.numbers(depth, before.height_count + 2 * std::size_t{before.edge_count});
        EdgesLeft left{listed, 0, heights, 0, before.crossed};
        const auto add_height = [&](double height) {
            if (height > box.high_y) {
                ++left.crossed;
            } else if (height > box.low_y) {
                // Where one edge of a chain ends and the next begins, the two cancel.
                if (left.height_count > 0 && heights[left.height_count - 1] == height) {
                    --left.height_count;
                } else {
                    heights[left.height_count++] = height;
                }
            }
        };
        for (std::uint32_t i = 0; i < before.height_count; ++i) {
            add_height(before.heights[i]);
        }
        const SideOfLines sides(box, reach_);
        for (std::uint32_t i = 0; i < before.edge_count; ++i) {
            const std::uint32_t edge = before.edges[i];
            const double start_y = edges_.start_y[edge];
            const double end_y = edges_.end_y[edge];
            // A ray is level with an edge from its lower end up to just below its upper one.
            if (std::max(start_y, end_y) <= box.low_y || std::min(start_y, end_y) > box.high_y) {
                continue;
            }
            switch (sides.Of(edges_.start_x[edge], start_y, edges_.end_x[edge], end_y)) {
                case Position::ahead:
                    add_height(start_y);
                    add_height(end_y);
                    break;
                case Position::behind:
                    break;
                case Position::undecided:
                    listed[left.edge_count++] = edge;
                    break;
            }
        }
        return left;
    }

    void SolveGroup(const std::uint32_t* chosen, std::uint32_t count, const EdgesLeft& left) {
        double numbers[4][max_lanes] = {};
        for (std::uint32_t i = 0; i < max_lanes; ++i) {
            const std::uint32_t ray = chosen[std::min(i, count - 1)];
            numbers[0][i] = x_[ray];
            numbers[1][i] = y_[ray];
            if (along_x_ != nullptr) {
                numbers[2][i] = along_x_[ray];
                numbers[3][i] = along_y_[ray];
            }
        }
        const Tag tag;
        const auto step = static_cast<std::uint32_t>(hn::Lanes(tag));
        for (std::uint32_t i = 0; i < count; i += step) {
            const Lanes x = hn::LoadU(tag, numbers[0] + i);
            const Lanes y = hn::LoadU(tag, numbers[1] + i);
            std::uint32_t odd =
                along_x_ == nullptr
                    ? OddOf(x, y, left, NoneLeftOut())
                    : OddOf(x, y, left,
                            LineLeftOut(hn::LoadU(tag, numbers[2] + i),
                                        hn::LoadU(tag, numbers[3] + i), rays_.rounding));
            for (std::uint32_t k = 0; k < left.height_count; ++k) {
                odd ^= bits_of(hn::Gt(hn::Set(tag, left.heights[k]), y));
            }
            for (std::uint32_t k = i; k < std::min(count, i + step); ++k) {
                odd_[chosen[k]] = static_cast<std::uint8_t>((left.crossed ^ (odd >> (k - i))) & 1U);
            }
        }
    }

    /// One bit per ray: whether it crosses an odd number of the edges that are left.
    template <class LeftOut>
    HWY_INLINE std::uint32_t OddOf(Lanes x, Lanes y, const EdgesLeft& left,
                                   const LeftOut& left_out) const {
        const Lanes ahead_of = hn::Add(x, hn::Set(Tag(), reach_));
        std::uint32_t odd = 0;
        for (std::uint32_t i = 0; i < left.edge_count; ++i) {
            const EdgeLanes edge = EdgeLanes::Same(edges_, left.edges[i]);
            // As for whole boxes: what lies ahead or behind is not left to rounding.
            const LaneMask ahead = hn::Gt(hn::Min(edge.start_x, edge.end_x), ahead_of);
            const LaneMask behind = hn::Lt(hn::Max(edge.start_x, edge.end_x), x);
            const LaneMask level = hn::Xor(hn::Gt(edge.start_y, y), hn::Gt(edge.end_y, y));
            const LaneMask crossing =
                hn::AndNot(left_out.Are(edge, x, y), are_negative(crossings(edge, x, y)));
            odd ^=
                bits_of(hn::Or(hn::And(ahead, level), hn::AndNot(hn::Or(ahead, behind), crossing)));
        }
        return odd;
    }

    const EdgeArrays edges_;
    const Rays& rays_;
    const double* const x_;
    const double* const y_;
    const double* const along_x_;
    const double* const along_y_;
    const double reach_;
    DivisionMemory& memory_;
    std::uint8_t* const odd_;
    SparseCheckpoint<16> checkpoint_;
};

void FindOddCrossings(const EdgeArrays& edges, const Rays& rays, DivisionMemory& memory,
                      std::uint8_t* odd) {
    if (rays.upwards) {
        CrossingsByDivision<true>(edges, rays, memory, odd).Solve();
    } else {
        CrossingsByDivision<false>(edges, rays, memory, odd).Solve();
    }
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindOddCrossings);

void find_odd_crossings(const EdgeArrays& edges, const Rays& rays, DivisionMemory& memory,
                        std::uint8_t* odd) {
    HWY_DYNAMIC_DISPATCH(FindOddCrossings)(edges, rays, memory, odd);
}

}  // namespace nearfield::simd::kernels
#endif
