#include <engine/simd/crossing_kernels.hpp>

#include <bit>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/crossing_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/left_out_edges-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

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
        const BoxArrays& eight = tree_.boxes(level, first);
        std::uint32_t ahead = 0;
        std::uint32_t around = 0;
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const LanesOfExtent boxes = turned<upwards>(boxes_at(eight, first + i));
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
        if (lowest >= tree_.count(0)) {
            return 0;  // every ring has closed
        }
        const auto of_edges = static_cast<std::uint32_t>(lowest);
        const std::uint32_t edge = tree_.edges_of(of_edges).first;
        const bool is_y = !upwards;
        return (edges_.start_y[edge] > y_) != (tree_.ring_start(of_edges, is_y) > y_) ? 1U : 0U;
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
    const double x_;
    const double y_;
    const LeftOut& left_out_;
    VisitsLeft& left_;
    std::uint32_t crossed_ = 0;
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

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(CrossingsAreOdd);
HWY_EXPORT(CrossingsOfOthersAreOdd);

bool contain(const AabbTree& tree, double x, double y) {
    VisitsLeft unlimited;
    return crossings_are_odd(tree, {x, y}, unlimited);
}

bool crossings_are_odd(const AabbTree& tree, const Ray& ray, VisitsLeft& left) {
    return HWY_DYNAMIC_DISPATCH(CrossingsAreOdd)(tree, ray, left);
}

bool crossings_of_others_are_odd(const AabbTree& tree, const Ray& ray, const LineOfEdge& line,
                                 VisitsLeft& left) {
    return HWY_DYNAMIC_DISPATCH(CrossingsOfOthersAreOdd)(tree, ray, line, left);
}

}  // namespace nearfield::simd::kernels
#endif
