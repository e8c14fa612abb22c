#include <engine/exact/stretches.hpp>

#include <algorithm>

// Highway compiles what follows once for every instruction set, by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/exact/stretch_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/exact/box_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::exact::kernels::HWY_NAMESPACE {

/// Cuts what is left, from ... to, down to where `at` + t * `by` is between two bounds. Nothing
/// that is no number cuts anything.
HWY_INLINE void cut_to_slab(Lanes at, Lanes by, Lanes low, Lanes high, Lanes& from, Lanes& to) {
    const Lanes one = hn::Div(hn::Sub(low, at), by);
    const Lanes other = hn::Div(hn::Sub(high, at), by);
    const Lanes first = hn::Min(one, other);
    const Lanes last = hn::Max(one, other);
    from = hn::IfThenElse(hn::Gt(first, from), first, from);
    to = hn::IfThenElse(hn::Lt(last, to), last, to);
}

/// One edge held against others.
class StretchSearch {
public:
    HWY_INLINE StretchSearch(const EdgeArrays& edges, std::uint32_t edge, double reach,
                             Stretch* found)
        : reach_(hn::Set(Tag(), reach)),
          box_(lanes_of(extent_of(edges, edge, reach))),
          start_x_(hn::Set(Tag(), edges.start_x[edge])),
          start_y_(hn::Set(Tag(), edges.start_y[edge])),
          along_x_(hn::Set(Tag(), edges.end_x[edge] - edges.start_x[edge])),
          along_y_(hn::Set(Tag(), edges.end_y[edge] - edges.start_y[edge])),
          found_(found) {}

    /// What others have to meet to be near.
    [[nodiscard]] HWY_INLINE const LanesOfExtent& box() const { return box_; }
    [[nodiscard]] HWY_INLINE std::uint32_t count() const { return count_; }

    /// At the edges i, i + 1, ... before `end`; returns whether more can be found.
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
        double starts[most_lanes];
        double ends[most_lanes];
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
    /// Around each of the others lies a rectangle, `reach` away on all sides.
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
        // Too short to have a direction.
        const LaneMask has_length = hn::Gt(squared, hn::Set(tag, 1e-200));
        from = hn::IfThenElse(has_length, first, from);
        to = hn::IfThenElse(has_length, last, to);
    }

    /// False where the whole edge is found.
    HWY_INLINE bool Add(const Stretch& stretch) {
        Stretch* last = found_ + count_ - 1;
        // Others that follow each other are near in places that do.
        if (count_ > 0 && stretch.from <= last->to && last->from <= stretch.to) {
            last->from = std::min(last->from, stretch.from);
            last->to = std::max(last->to, stretch.to);
        } else if (count_ < most_stretches) {
            last = found_ + count_++;
            *last = stretch;
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
    Stretch* found_;
    std::uint32_t count_ = 0;
};

std::uint32_t FindStretchesNear(const EdgeArrays& edges, std::uint32_t edge,
                                const EdgeArrays& others, double reach, Stretch* found) {
    StretchSearch search(edges, edge, reach, found);
    for (std::size_t i = 0; i < others.count; i += hn::Lanes(Tag())) {
        if (!search.Look(others, i, others.count)) {
            break;
        }
    }
    return search.count();
}

std::uint32_t FindStretchesNearTree(const EdgeArrays& edges, std::uint32_t edge,
                                    const BoxTree& others, double reach, Stretch* found) {
    StretchSearch search(edges, edge, reach, found);
    for_leaves(
        others, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, search.box()); },
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

}  // namespace nearfield::exact::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::exact::kernels {

HWY_EXPORT(FindStretchesNear);
HWY_EXPORT(FindStretchesNearTree);

std::uint32_t find_stretches_near(const EdgeArrays& edges, std::uint32_t edge,
                                  const EdgeArrays& others, double reach, Stretch* found) {
    return HWY_DYNAMIC_DISPATCH(FindStretchesNear)(edges, edge, others, reach, found);
}

std::uint32_t find_stretches_near(const EdgeArrays& edges, std::uint32_t edge,
                                  const BoxTree& others, double reach, Stretch* found) {
    return HWY_DYNAMIC_DISPATCH(FindStretchesNearTree)(edges, edge, others, reach, found);
}

}  // namespace nearfield::exact::kernels
#endif
