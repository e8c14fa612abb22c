#include <engine/base/interruption.hpp>
#include <engine/simd/crossing_kernels.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/crossing_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/box_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

// Exchanging x and y turns an upward ray into one to the right.
template <bool upwards>
HWY_INLINE EdgeArrays turned(const EdgeArrays& edges) {
    return upwards ? EdgeArrays{edges.count, edges.start_y, edges.start_x, edges.end_y, edges.end_x}
                   : edges;
}
template <bool upwards>
HWY_INLINE LanesOfExtent turned(const LanesOfExtent& boxes) {
    return upwards ? LanesOfExtent{boxes.low_y, boxes.low_x, boxes.high_y, boxes.high_x} : boxes;
}

/// Counts the crossings of a ray with the edges, modulo 2. A run of consecutive boxes wholly ahead
/// of the point need not be entered: it holds a piece of the boundary, which crosses the ray an odd
/// number of times exactly if its ends lie on different sides. So only boxes around the point are
/// entered, however many lie on the ray. `LeftOut` identifies edges at the point that do not count.
template <bool upwards, class LeftOut>
class RayCrossings {
public:
    HWY_INLINE RayCrossings(const AabbTree& tree, const Ray& ray, const LeftOut& left_out,
                            VisitsLeft& left)
        : tree_(tree),
          edges_(turned<upwards>(tree.edges())),
          ring_starts_(upwards ? tree.ring_starts().x : tree.ring_starts().y),
          x_(upwards ? ray.y : ray.x),
          y_(upwards ? ray.x : ray.y),
          left_out_(left_out),
          left_(left) {}

    HWY_INLINE bool AreOdd() {
        for_leaves_opened(
            tree_,
            [this](std::uint32_t level, std::uint32_t first)
                HWY_ATTR { return Open(level, first); },
            [this](std::uint32_t box) HWY_ATTR {
                CountEdges(tree_.edges_of(box));
                return left_.count > 0;
            });
        return (crossed_ & 1U) != 0;
    }

private:
    /// Counts the boxes among eight that lie ahead; returns a mask of those to enter.
    HWY_INLINE std::uint32_t Open(std::uint32_t level, std::uint32_t first) {
        if (left_.count == 0) {
            return 0;
        }
        --left_.count;
        const Tag tag;
        const Lanes x = hn::Set(tag, x_);
        const Lanes y = hn::Set(tag, y_);
        std::uint32_t ahead = 0;
        std::uint32_t around = 0;
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const LanesOfExtent boxes = turned<upwards>(boxes_at(tree_.level(level), first + i));
            const LaneMask level_with = hn::And(hn::Le(boxes.low_y, y), hn::Ge(boxes.high_y, y));
            // Rounding may make a left-out edge appear to lie ahead.
            const LaneMask is_ahead = hn::Gt(boxes.low_x, hn::Set(tag, x_ + left_out_.Reach()));
            const LaneMask not_behind = hn::Ge(boxes.high_x, x);
            ahead |= bits_of(is_ahead) << i;
            around |= bits_of(hn::AndNot(is_ahead, hn::And(level_with, not_behind))) << i;
        }
        while (ahead != 0) {
            const auto begin = static_cast<std::uint32_t>(std::countr_zero(ahead));
            const std::uint32_t end =
                begin + static_cast<std::uint32_t>(std::countr_one(ahead >> begin));
            crossed_ ^= RingHasCrossed(level, first + begin) ^ RingHasCrossed(level, first + end);
            ahead &= ~0U << end;
        }
        return around;
    }

    /// Returns 1 if a box begins on the other side of the ray's line than its ring does. The
    /// difference between two boxes gives the crossings of the ring pieces from one to the other;
    /// whole rings in between cross an even number of times.
    [[nodiscard]] HWY_INLINE std::uint32_t RingHasCrossed(std::uint32_t level,
                                                          std::uint32_t box) const {
        constexpr auto bits = static_cast<std::uint32_t>(std::countr_zero(fan_out));
        const std::uint64_t lowest = std::uint64_t{box} << (bits * level);
        if (lowest >= tree_.level(0).count) {
            return 0;  // every ring has closed
        }
        const std::uint32_t edge = tree_.edges_of(static_cast<std::uint32_t>(lowest)).first;
        return (edges_.start_y[edge] > y_) != (ring_starts_[lowest] > y_) ? 1U : 0U;
    }

    HWY_INLINE void CountEdges(const EdgeRange& some) {
        const Tag tag;
        const Lanes x = hn::Set(tag, x_);
        const Lanes y = hn::Set(tag, y_);
        const std::uint32_t crossed = bits_of_eight([&](std::size_t i) HWY_ATTR {
            const EdgeLanes edges(edges_, some.first + i);
            return hn::AndNot(left_out_.Are(edges, x, y), are_negative(crossings(edges, x, y)));
        });
        crossed_ ^= static_cast<std::uint32_t>(std::popcount(crossed & bits_of_range(some)));
    }

    const AabbTree& tree_;
    const EdgeArrays edges_;
    const double* const ring_starts_;
    const double x_;
    const double y_;
    const LeftOut& left_out_;
    VisitsLeft& left_;
    std::uint32_t crossed_ = 0;
};

struct NoneLeftOut {
    [[nodiscard]] HWY_INLINE double Reach() const { return 0.0; }
    [[nodiscard]] HWY_INLINE LaneMask Are(const EdgeLanes& /*edges*/, Lanes x, Lanes /*y*/) const {
        return hn::Lt(x, x);
    }
};

/// Leaves out edges that run along a line through the point, as far as the rounding of the edges
/// and of the point allows this to be decided.
class LineLeftOut {
public:
    HWY_INLINE LineLeftOut(Lanes along_x, Lanes along_y, double rounding)
        : along_x_(along_x), along_y_(along_y), reach_(4.0 * rounding) {}
    HWY_INLINE LineLeftOut(const LineOfEdge& line, bool upwards)
        : LineLeftOut(hn::Set(Tag(), upwards ? line.along_y : line.along_x),
                      hn::Set(Tag(), upwards ? line.along_x : line.along_y), line.rounding) {}

    [[nodiscard]] HWY_INLINE double Reach() const { return reach_; }
    [[nodiscard]] HWY_INLINE LaneMask Are(const EdgeLanes& edges, Lanes x, Lanes y) const {
        const Lanes reach = hn::Set(Tag(), reach_);
        const Lanes edge_x = hn::Sub(edges.end_x, edges.start_x);
        const Lanes edge_y = hn::Sub(edges.end_y, edges.start_y);
        // The sum of the coordinates bounds the length from above and needs no square root.
        const Lanes length = hn::Add(hn::Abs(edge_x), hn::Abs(edge_y));
        const Lanes lengths = hn::Add(length, hn::Add(hn::Abs(along_x_), hn::Abs(along_y_)));
        const Lanes beside = hn::Abs(
            cross_lanes(edge_x, edge_y, hn::Sub(x, edges.start_x), hn::Sub(y, edges.start_y)));
        const Lanes aslant = hn::Abs(cross_lanes(along_x_, along_y_, edge_x, edge_y));
        return hn::And(hn::Le(beside, hn::Mul(reach, length)),
                       hn::Le(aslant, hn::Mul(reach, lengths)));
    }

private:
    Lanes along_x_;
    Lanes along_y_;
    double reach_;
};

template <class LeftOut>
HWY_INLINE bool are_odd(const AabbTree& tree, const Ray& ray, const LeftOut& left_out,
                        VisitsLeft& left) {
    return ray.upwards ? RayCrossings<true, LeftOut>(tree, ray, left_out, left).AreOdd()
                       : RayCrossings<false, LeftOut>(tree, ray, left_out, left).AreOdd();
}

bool CrossingsAreOdd(const AabbTree& tree, const Ray& ray, VisitsLeft& left) {
    return are_odd(tree, ray, NoneLeftOut(), left);
}

bool CrossingsOfOthersAreOdd(const AabbTree& tree, const Ray& ray, const LineOfEdge& line,
                             VisitsLeft& left) {
    return are_odd(tree, ray, LineLeftOut(line, ray.upwards), left);
}

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
        const Extent box = BoxOf(chosen, count);
        const EdgesLeft left = Narrow(box, before, depth);
        if (count <= max_lanes || left.edge_count + left.height_count == 0) {
            for (std::uint32_t i = 0; i < count; i += max_lanes) {
                SolveGroup(chosen + i, std::min<std::uint32_t>(count - i, max_lanes), left);
            }
            return;
        }
        const double* const along = box.high_x - box.low_x > box.high_y - box.low_y ? x_ : y_;
        const std::uint32_t half = count / 2;
        std::nth_element(chosen, chosen + half, chosen + count,
                         [along](std::uint32_t i, std::uint32_t j) { return along[i] < along[j]; });
        Divide(chosen, half, left, depth + 1);
        Divide(chosen + half, count - half, left, depth + 1);
    }

    [[nodiscard]] Extent BoxOf(const std::uint32_t* chosen, std::uint32_t count) const {
        Extent box{x_[*chosen], y_[*chosen], x_[*chosen], y_[*chosen]};
        for (std::uint32_t i = 1; i < count; ++i) {
            const double x = x_[chosen[i]];
            const double y = y_[chosen[i]];
            box = {std::min(box.low_x, x), std::min(box.low_y, y), std::max(box.high_x, x),
                   std::max(box.high_y, y)};
        }
        return box;
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

HWY_EXPORT(CrossingsAreOdd);
HWY_EXPORT(CrossingsOfOthersAreOdd);
HWY_EXPORT(FindOddCrossings);

bool contain(const AabbTree& tree, double x, double y) {
    return crossings_are_odd(tree, {x, y});
}

bool crossings_are_odd(const AabbTree& tree, const Ray& ray) {
    VisitsLeft unlimited;
    return crossings_are_odd(tree, ray, unlimited);
}

bool crossings_are_odd(const AabbTree& tree, const Ray& ray, VisitsLeft& left) {
    return HWY_DYNAMIC_DISPATCH(CrossingsAreOdd)(tree, ray, left);
}

bool crossings_of_others_are_odd(const AabbTree& tree, const Ray& ray, const LineOfEdge& line) {
    VisitsLeft unlimited;
    return crossings_of_others_are_odd(tree, ray, line, unlimited);
}

bool crossings_of_others_are_odd(const AabbTree& tree, const Ray& ray, const LineOfEdge& line,
                                 VisitsLeft& left) {
    return HWY_DYNAMIC_DISPATCH(CrossingsOfOthersAreOdd)(tree, ray, line, left);
}

void find_odd_crossings(const EdgeArrays& edges, const Rays& rays, DivisionMemory& memory,
                        std::uint8_t* odd) {
    HWY_DYNAMIC_DISPATCH(FindOddCrossings)(edges, rays, memory, odd);
}

}  // namespace nearfield::simd::kernels
#endif
