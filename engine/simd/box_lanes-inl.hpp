// Shared by the kernels over boxes, per instruction set: each kernel source includes this file as
// often as Highway includes that source.

#include <engine/simd/aabb_tree.hpp>

#include <bit>
#include <cmath>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_EXACT_BOX_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_EXACT_BOX_LANES_INL_HPP
#undef NEARFIELD_EXACT_BOX_LANES_INL_HPP
#else
#define NEARFIELD_EXACT_BOX_LANES_INL_HPP
#endif

#include <engine/simd/lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

constexpr std::uint32_t fan_out = AabbTree::fan_out;

/// A mask with one bit per edge, for up to eight edges.
HWY_INLINE std::uint32_t bits_of_range(const EdgeRange& edges) {
    return ~0U >> (32 - (edges.end - edges.first));
}

/// A mask of eight comparisons; `compare(i)` compares lanes i, i + 1, ...
template <class Compare>
HWY_INLINE std::uint32_t bits_of_eight(const Compare& compare) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
        bits |= bits_of(compare(i)) << i;
    }
    return bits;
}

/// Loads the boxes i, i + 1, ...
HWY_INLINE LanesOfExtent boxes_at(const BoxArrays& boxes, std::size_t i) {
    const Tag tag;
    return {hn::LoadU(tag, boxes.low_x + i), hn::LoadU(tag, boxes.low_y + i),
            hn::LoadU(tag, boxes.high_x + i), hn::LoadU(tag, boxes.high_y + i)};
}

/// Squared distances between boxes, lane by lane; 0 where they intersect. A point is a box too.
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

/// Loads the edges i, i + 1, ..., including their lengths.
HWY_INLINE EdgesAlong edges_along(const EdgeArrays& edges, std::size_t i) {
    EdgesAlong along(edges, i);
    const Lanes squared =
        hn::Add(hn::Mul(along.along_x, along.along_x), hn::Mul(along.along_y, along.along_y));
    along.inverse_length = hn::Div(hn::Set(Tag(), 1.0), squared);
    return along;
}

/// The least distance so far, plus a margin.
class LeastBound {
public:
    HWY_INLINE LeastBound(double most, double margin) : margin_(margin), least_(most) {
        Take(most);
    }

    [[nodiscard]] HWY_INLINE double squared() const { return squared_; }
    [[nodiscard]] HWY_INLINE double least() const { return least_; }
    HWY_INLINE void Take(double squared) {
        if (squared <= least_) {
            least_ = squared;
            const double length = std::sqrt(squared) + margin_;
            squared_ = length * length;
        }
    }

private:
    double margin_;
    double least_;
    double squared_ = 0.0;
};

/// Calls `use(box)` for each lowest-level box that is entered along with all boxes above it, until
/// it returns false; `open(level, first)` returns a mask of the boxes to enter among eight.
template <class Open, class Use>
HWY_INLINE void for_leaves_opened(const AabbTree& tree, const Open& open, const Use& use) {
    // A stack of the remaining boxes among eight, one entry per level.
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

/// The same, where `enter(boxes)` returns the lanes to enter.
template <class Enter, class Use>
HWY_INLINE void for_leaves(const AabbTree& tree, const Enter& enter, const Use& use) {
    for_leaves_opened(
        tree,
        [&](std::uint32_t level, std::uint32_t first) HWY_ATTR {
            const BoxArrays& boxes = tree.boxes(level, first);
            return bits_of_eight([&](std::size_t i)
                                     HWY_ATTR { return enter(boxes_at(boxes, first + i)); });
        },
        use);
}

// Defined in tree_kernels.cpp, for other kernels of the same instruction set.

NearEdge FindNearer(const AabbTree& tree, double x, double y, const NearEdge& guess,
                    VisitsLeft& left);
/// Stops once it has found more than `enough`.
std::uint32_t FindEdgesWithinByTree(const AabbTree& tree, double point_x, double point_y,
                                    double most, std::uint32_t enough, VisitsLeft& left,
                                    std::uint32_t* found);

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
