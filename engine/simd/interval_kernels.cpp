#include <engine/simd/parameter_intervals.hpp>

#include <algorithm>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/interval_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/box_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// Clips the interval [from, to] to where `at` + t * `by` is between two bounds. NaN bounds do not
/// clip.
HWY_INLINE void cut_to_slab(Lanes at, Lanes by, Lanes low, Lanes high, Lanes& from, Lanes& to) {
    const Lanes one = hn::Div(hn::Sub(low, at), by);
    const Lanes other = hn::Div(hn::Sub(high, at), by);
    const Lanes first = hn::Min(one, other);
    const Lanes last = hn::Max(one, other);
    from = hn::IfThenElse(hn::Gt(first, from), first, from);
    to = hn::IfThenElse(hn::Lt(last, to), last, to);
}

/// Compares one edge with others.
class IntervalSearch {
public:
    HWY_INLINE IntervalSearch(const EdgeArrays& edges, std::uint32_t edge, double reach,
                              ParameterInterval* found)
        : reach_(hn::Set(Tag(), reach)),
          box_(lanes_of(extent_of(edges, edge, reach))),
          start_x_(hn::Set(Tag(), edges.start_x[edge])),
          start_y_(hn::Set(Tag(), edges.start_y[edge])),
          along_x_(hn::Set(Tag(), edges.end_x[edge] - edges.start_x[edge])),
          along_y_(hn::Set(Tag(), edges.end_y[edge] - edges.start_y[edge])),
          found_(found) {}

    /// Only edges that intersect this box can be near.
    [[nodiscard]] HWY_INLINE const LanesOfExtent& box() const { return box_; }
    [[nodiscard]] HWY_INLINE std::uint32_t count() const { return count_; }

    /// Tests the edges i, i + 1, ... before `end`; returns whether more can be found.
    HWY_INLINE bool Look(const EdgeArrays& others, std::size_t i, std::size_t end) {
        const Tag tag;
        const EdgeLanes lanes(others, i);
        LaneMask near = hn::And(meet(box_, lanes), hn::FirstN(tag, end - i));
        if (hn::AllFalse(tag, near)) {
            return true;
        }
        Lanes from = hn::Zero(tag);
        Lanes to = hn::Set(tag, 1.0);
        CutToRectangles(lanes, from, to);
        near = hn::And(near, hn::Le(from, to));
        double starts[max_lanes];
        double ends[max_lanes];
        hn::StoreU(from, tag, starts);
        hn::StoreU(to, tag, ends);
        for (std::uint32_t bits = bits_of(near); bits != 0; bits &= bits - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
            if (!Add({starts[lane], ends[lane]})) {
                return false;
            }
        }
        return true;
    }

private:
    /// Clips to the rectangles that extend `reach` beyond each of the other edges on all sides.
    HWY_INLINE void CutToRectangles(const EdgeLanes& others, Lanes& from, Lanes& to) const {
        const Tag tag;
        const Lanes x = hn::Sub(others.end_x, others.start_x);
        const Lanes y = hn::Sub(others.end_y, others.start_y);
        const Lanes to_x = hn::Sub(start_x_, others.start_x);
        const Lanes to_y = hn::Sub(start_y_, others.start_y);
        const Lanes squared = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
        const Lanes wide = hn::Mul(reach_, hn::Sqrt(squared));
        Lanes first = hn::Zero(tag);
        Lanes last = hn::Set(tag, 1.0);
        cut_to_slab(cross_lanes(x, y, to_x, to_y), cross_lanes(x, y, along_x_, along_y_),
                    hn::Neg(wide), wide, first, last);
        cut_to_slab(hn::Add(hn::Mul(x, to_x), hn::Mul(y, to_y)),
                    hn::Add(hn::Mul(x, along_x_), hn::Mul(y, along_y_)), hn::Neg(wide),
                    hn::Add(squared, wide), first, last);
        // Excludes edges too short to have a direction.
        const LaneMask has_length = hn::Gt(squared, hn::Set(tag, 1e-200));
        from = hn::IfThenElse(has_length, first, from);
        to = hn::IfThenElse(has_length, last, to);
    }

    /// Returns false once the interval is the whole edge.
    HWY_INLINE bool Add(const ParameterInterval& interval) {
        ParameterInterval* last = found_ + count_ - 1;
        // Consecutive edges are usually near consecutive parts of the edge.
        if (count_ > 0 && interval.from <= last->to && last->from <= interval.to) {
            last->from = std::min(last->from, interval.from);
            last->to = std::max(last->to, interval.to);
        } else if (count_ < max_intervals) {
            last = found_ + count_++;
            *last = interval;
        } else {
            last = found_;
            *last = {};
            count_ = 1;
        }
        if (last->from > 0.0 || last->to < 1.0) {
            return true;
        }
        *found_ = *last;
        count_ = 1;
        return false;
    }

    Lanes reach_;
    LanesOfExtent box_;
    Lanes start_x_;
    Lanes start_y_;
    Lanes along_x_;
    Lanes along_y_;
    ParameterInterval* found_;
    std::uint32_t count_ = 0;
};

std::uint32_t FindIntervalsNear(const EdgeArrays& edges, std::uint32_t edge,
                                const EdgeArrays& others, double reach, ParameterInterval* found) {
    IntervalSearch search(edges, edge, reach, found);
    for (std::size_t i = 0; i < others.count; i += hn::Lanes(Tag())) {
        if (!search.Look(others, i, others.count)) {
            break;
        }
    }
    return search.count();
}

std::uint32_t FindIntervalsNearTree(const EdgeArrays& edges, std::uint32_t edge,
                                    const AabbTree& others, double reach, VisitsLeft& left,
                                    ParameterInterval* found) {
    IntervalSearch search(edges, edge, reach, found);
    for_leaves_opened(
        others,
        [&](std::uint32_t level, std::uint32_t first) HWY_ATTR {
            if (left.count == 0) {
                return 0U;
            }
            --left.count;
            const BoxArrays& boxes = others.boxes(level, first);
            return bits_of_eight([&](std::size_t i) HWY_ATTR {
                return meet(boxes_at(boxes, first + i), search.box());
            });
        },
        [&](std::uint32_t box) HWY_ATTR {
            const EdgeRange some = others.edges_of(box);
            for (std::size_t i = some.first; i < some.end; i += hn::Lanes(Tag())) {
                if (!search.Look(others.edges(), i, some.end)) {
                    return false;
                }
            }
            return true;
        });
    return search.count();
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindIntervalsNear);
HWY_EXPORT(FindIntervalsNearTree);

std::uint32_t find_intervals_near(const EdgeArrays& edges, std::uint32_t edge,
                                  const EdgeArrays& others, double reach,
                                  ParameterInterval* found) {
    return HWY_DYNAMIC_DISPATCH(FindIntervalsNear)(edges, edge, others, reach, found);
}

std::uint32_t find_intervals_near(const EdgeArrays& edges, std::uint32_t edge,
                                  const AabbTree& others, double reach, VisitsLeft& left,
                                  ParameterInterval* found) {
    return HWY_DYNAMIC_DISPATCH(FindIntervalsNearTree)(edges, edge, others, reach, left, found);
}

}  // namespace nearfield::simd::kernels
#endif
