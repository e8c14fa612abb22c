// What the kernels over boxes have in common, for every instruction set: included by each source of
// kernels as often as Highway includes that source.

#include <engine/exact/box_tree.hpp>

#include <bit>

// A guard for each instruction set, as Highway has it.
#if defined(NEARFIELD_EXACT_BOX_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_EXACT_BOX_LANES_INL_HPP
#undef NEARFIELD_EXACT_BOX_LANES_INL_HPP
#else
#define NEARFIELD_EXACT_BOX_LANES_INL_HPP
#endif

#include <engine/exact/lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::exact::kernels::HWY_NAMESPACE {

constexpr std::uint32_t fan_out = BoxTree::fan_out;

/// A bit for each of up to eight edges.
HWY_INLINE std::uint32_t bits_of_range(const EdgeRange& edges) {
    return ~0U >> (32 - (edges.end - edges.first));
}

/// The bits of eight comparisons; `compare(i)` makes those of lanes i, i + 1, ...
template <class Compare>
HWY_INLINE std::uint32_t bits_of_eight(const Compare& compare) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
        bits |= bits_of(compare(i)) << i;
    }
    return bits;
}

/// Of the boxes i, i + 1, ...
HWY_INLINE LanesOfExtent boxes_at(const BoxArrays& boxes, std::size_t i) {
    const Tag tag;
    return {hn::LoadU(tag, boxes.low_x + i), hn::LoadU(tag, boxes.low_y + i),
            hn::LoadU(tag, boxes.high_x + i), hn::LoadU(tag, boxes.high_y + i)};
}

HWY_INLINE Extent box_at(const BoxArrays& boxes, std::size_t i) {
    return {boxes.low_x[i], boxes.low_y[i], boxes.high_x[i], boxes.high_y[i]};
}

/// Between boxes, lane by lane; 0 where they meet. A point is a box too.
HWY_INLINE Lanes squared_between(const LanesOfExtent& a, const LanesOfExtent& b) {
    const Lanes zero = hn::Zero(Tag());
    const Lanes off_x =
        hn::Max(hn::Max(hn::Sub(a.low_x, b.high_x), hn::Sub(b.low_x, a.high_x)), zero);
    const Lanes off_y =
        hn::Max(hn::Max(hn::Sub(a.low_y, b.high_y), hn::Sub(b.low_y, a.high_y)), zero);
    return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
}

HWY_INLINE LaneMask meet(const LanesOfExtent& a, const LanesOfExtent& b) {
    return hn::And(hn::And(hn::Le(a.low_x, b.high_x), hn::Le(b.low_x, a.high_x)),
                   hn::And(hn::Le(a.low_y, b.high_y), hn::Le(b.low_y, a.high_y)));
}

HWY_INLINE Extent grown(const Extent& box, double by) {
    return {box.low_x - by, box.low_y - by, box.high_x + by, box.high_y + by};
}

/// Of the edges i, i + 1, ..., their lengths included.
HWY_INLINE EdgesAlong edges_along(const EdgeArrays& edges, std::size_t i) {
    EdgesAlong along(edges, i);
    const Lanes squared =
        hn::Add(hn::Mul(along.along_x, along.along_x), hn::Mul(along.along_y, along.along_y));
    along.inverse_length = hn::Div(hn::Set(Tag(), 1.0), squared);
    return along;
}

/// Calls `use(box)` for each box of the lowest level that is entered with all boxes above it, as
/// long as it says so; `open(level, first)` says which of eight boxes are, a bit each.
template <class Open, class Use>
HWY_INLINE void for_leaves_opened(const BoxTree& tree, const Open& open, const Use& use) {
    // A stack of what is left of eight boxes, a level each.
    std::uint32_t bits[10];
    std::uint32_t first[10];
    const auto descend_to = [&](std::uint32_t level, std::uint32_t begin) HWY_ATTR {
        first[level] = begin;
        bits[level] = open(level, begin);
    };
    const std::uint32_t top = tree.top_level();
    std::uint32_t level = top;
    descend_to(top, 0);
    for (;;) {
        if (bits[level] == 0) {
            if (level == top) {
                return;
            }
            ++level;
            continue;
        }
        const std::uint32_t box =
            first[level] + static_cast<std::uint32_t>(std::countr_zero(bits[level]));
        bits[level] &= bits[level] - 1;
        if (level == 0) {
            if (!use(box)) {
                return;
            }
        } else {
            --level;
            descend_to(level, fan_out * box);
        }
    }
}

/// The same where `enter(boxes)` says which of some boxes are.
template <class Enter, class Use>
HWY_INLINE void for_leaves(const BoxTree& tree, const Enter& enter, const Use& use) {
    for_leaves_opened(
        tree,
        [&](std::uint32_t level, std::uint32_t first) HWY_ATTR {
            return bits_of_eight([&](std::size_t i) HWY_ATTR {
                return enter(boxes_at(tree.level(level), first + i));
            });
        },
        use);
}

// Of tree_kernels.cpp, for other kernels of the same instruction set.

NearEdge FindNearer(const BoxTree& tree, double x, double y, const NearEdge& guess);
/// Stops where it has found more than `enough`.
std::uint32_t FindEdgesWithinByTree(const BoxTree& tree, double point_x, double point_y,
                                    double most, std::uint32_t enough, std::uint32_t* found);

}  // namespace nearfield::exact::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
