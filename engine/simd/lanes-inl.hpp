// Shared by the kernels, per instruction set: each kernel source includes this file as often as
// Highway includes that source.

#include <engine/simd/edge_kernels.hpp>

#include <bit>
#include <limits>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_EXACT_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_EXACT_LANES_INL_HPP
#undef NEARFIELD_EXACT_LANES_INL_HPP
#else
#define NEARFIELD_EXACT_LANES_INL_HPP
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, max_lanes>;
using Lanes = hn::Vec<Tag>;
using LaneMask = hn::Mask<Tag>;

/// One bit per lane, the first lane lowest.
HWY_INLINE std::uint32_t bits_of(LaneMask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return bits[0];
}

/// Appends the indices of the set lanes to a list, except those from `end` on.
HWY_INLINE std::uint32_t append_lanes(LaneMask mask, std::size_t first, std::uint32_t end,
                                      std::uint32_t* found, std::uint32_t count) {
    for (std::uint32_t bits = bits_of(mask); bits != 0; bits &= bits - 1) {
        const auto index =
            static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(bits));
        if (index < end) {
            found[count++] = index;
        }
    }
    return count;
}

/// Calls `use(index)`, in ascending order, for the indices in [first, end) that pass the test.
/// `test(index)` tests one vector of consecutive indices.
template <class Test, class Use>
HWY_INLINE void for_each_that(std::size_t first, std::size_t end, const Test& test,
                              const Use& use) {
    // In blocks of 64: the branch that ends a loop over set bits is often mispredicted.
    constexpr std::size_t at_a_time = 64;
    for (; first < end; first += at_a_time) {
        const std::size_t count = end - first < at_a_time ? end - first : at_a_time;
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < count; i += hn::Lanes(Tag())) {
            bits |= std::uint64_t{bits_of(test(first + i))} << i;
        }
        bits &= ~std::uint64_t{0} >> (at_a_time - count);
        for (; bits != 0; bits &= bits - 1) {
            use(first + static_cast<std::size_t>(std::countr_zero(bits)));
        }
    }
}

/// Appends those indices to a list.
template <class Test>
HWY_INLINE std::uint32_t append_those_that(std::size_t first, std::size_t end, const Test& test,
                                           std::uint32_t* found, std::uint32_t count) {
    for_each_that(first, end, test, [&](std::size_t index) HWY_ATTR {
        found[count++] = static_cast<std::uint32_t>(index);
    });
    return count;
}

HWY_INLINE double min_lane(Lanes lanes) {
    return hn::GetLane(hn::MinOfLanes(Tag(), lanes));
}

HWY_INLINE double max_lane(Lanes lanes) {
    return hn::GetLane(hn::MaxOfLanes(Tag(), lanes));
}

/// Tests the sign bit only.
HWY_INLINE LaneMask are_negative(Lanes lanes) {
    const Tag tag;
    const hn::RebindToSigned<Tag> whole;
    return hn::RebindMask(tag, hn::Lt(hn::BitCast(whole, lanes), hn::Zero(whole)));
}

struct LanesOfExtent {
    Lanes low_x;
    Lanes low_y;
    Lanes high_x;
    Lanes high_y;
};

HWY_INLINE LanesOfExtent lanes_of(const Extent& box) {
    const Tag tag;
    return {hn::Set(tag, box.low_x), hn::Set(tag, box.low_y), hn::Set(tag, box.high_x),
            hn::Set(tag, box.high_y)};
}

/// The bounding box of the points from `first` on; at least one.
HWY_INLINE Extent extent_of(const PointArrays& points, std::uint32_t first) {
    const Tag tag;
    const Lanes first_x = hn::Set(tag, points.x[first]);
    const Lanes first_y = hn::Set(tag, points.y[first]);
    LanesOfExtent box{first_x, first_y, first_x, first_y};
    for (std::uint32_t i = first; i < points.count;
         i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
        const LaneMask is_point = hn::FirstN(tag, points.count - i);
        const Lanes x = hn::IfThenElse(is_point, hn::LoadU(tag, points.x + i), first_x);
        const Lanes y = hn::IfThenElse(is_point, hn::LoadU(tag, points.y + i), first_y);
        box = {hn::Min(box.low_x, x), hn::Min(box.low_y, y), hn::Max(box.high_x, x),
               hn::Max(box.high_y, y)};
    }
    return {min_lane(box.low_x), min_lane(box.low_y), max_lane(box.high_x), max_lane(box.high_y)};
}

/// The end points of the edges i, i + 1, ...
struct EdgeLanes {
    Lanes start_x;
    Lanes start_y;
    Lanes end_x;
    Lanes end_y;

    HWY_INLINE EdgeLanes(const EdgeArrays& edges, std::size_t i)
        : start_x(hn::LoadU(Tag(), edges.start_x + i)),
          start_y(hn::LoadU(Tag(), edges.start_y + i)),
          end_x(hn::LoadU(Tag(), edges.end_x + i)),
          end_y(hn::LoadU(Tag(), edges.end_y + i)) {}

    /// The end points of one edge in every lane.
    static HWY_INLINE EdgeLanes Same(const EdgeArrays& edges, std::size_t edge) {
        const Tag tag;
        EdgeLanes same;
        same.start_x = hn::Set(tag, edges.start_x[edge]);
        same.start_y = hn::Set(tag, edges.start_y[edge]);
        same.end_x = hn::Set(tag, edges.end_x[edge]);
        same.end_y = hn::Set(tag, edges.end_y[edge]);
        return same;
    }

    EdgeLanes() = default;
};

/// The points of edges nearest to given points, lane by lane.
struct NearestLanes {
    Lanes x;
    Lanes y;
    Lanes parameter;
    Lanes squared;  ///< distance
};

/// Bit for bit what geometry::nearest_on_segment() computes.
HWY_INLINE NearestLanes nearest_on_edges(const EdgeLanes& edges, Lanes x, Lanes y) {
    const Tag tag;
    const Lanes zero = hn::Zero(tag);
    const Lanes one = hn::Set(tag, 1.0);
    const Lanes along_x = hn::Sub(edges.end_x, edges.start_x);
    const Lanes along_y = hn::Sub(edges.end_y, edges.start_y);
    const Lanes along_of_point = hn::Add(hn::Mul(along_x, hn::Sub(x, edges.start_x)),
                                         hn::Mul(along_y, hn::Sub(y, edges.start_y)));
    const Lanes squared_length = hn::Add(hn::Mul(along_x, along_x), hn::Mul(along_y, along_y));
    const LaneMask after_start =
        hn::And(hn::Gt(along_of_point, zero), hn::Ne(squared_length, zero));
    const LaneMask before_end = hn::Lt(along_of_point, squared_length);
    const Lanes parameter = hn::Div(along_of_point, squared_length);
    // Computed from the nearer end, which loses less precision.
    const LaneMask in_first_half = hn::Lt(parameter, hn::Set(tag, 0.5));
    const Lanes back = hn::Sub(one, parameter);
    const auto nearest = [&](Lanes start, Lanes end, Lanes along) HWY_ATTR {
        const Lanes between =
            hn::IfThenElse(in_first_half, hn::Add(start, hn::Mul(parameter, along)),
                           hn::Sub(end, hn::Mul(back, along)));
        // Both ends are kept unchanged, so that a vertex can be distinguished from an edge.
        return hn::IfThenElse(after_start, hn::IfThenElse(before_end, between, end), start);
    };
    const Lanes nearest_x = nearest(edges.start_x, edges.end_x, along_x);
    const Lanes nearest_y = nearest(edges.start_y, edges.end_y, along_y);
    const Lanes off_x = hn::Sub(x, nearest_x);
    const Lanes off_y = hn::Sub(y, nearest_y);
    return {nearest_x, nearest_y,
            hn::IfThenElseZero(after_start, hn::IfThenElse(before_end, parameter, one)),
            hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y))};
}

/// Negative in a lane if the ray from a point to the right crosses the edge.
HWY_INLINE Lanes crossings(const EdgeLanes& edges, Lanes x, Lanes y) {
    // Only signs count; a difference is negative exactly if the comparison holds.
    const Lanes start_above = hn::Sub(y, edges.start_y);
    const Lanes end_above = hn::Sub(y, edges.end_y);
    const Lanes left =
        hn::Sub(hn::Mul(hn::Sub(edges.end_y, edges.start_y), hn::Sub(x, edges.start_x)),
                hn::Mul(hn::Sub(edges.end_x, edges.start_x), start_above));
    // Left of an edge that goes up, right of one that goes down: the ray to the right crosses it.
    return hn::AndNot(hn::Xor(left, end_above), hn::Xor(start_above, end_above));
}

/// Edges in the form used to measure distances.
struct EdgesAlong {
    Lanes start_x;
    Lanes start_y;
    Lanes along_x;
    Lanes along_y;
    Lanes inverse_length;  ///< 1 / squared length; any value for zero length

    EdgesAlong() = default;
    HWY_INLINE EdgesAlong(const EdgeArrays& edges, std::size_t i)
        : start_x(hn::LoadU(Tag(), edges.start_x + i)),
          start_y(hn::LoadU(Tag(), edges.start_y + i)),
          along_x(hn::Sub(hn::LoadU(Tag(), edges.end_x + i), start_x)),
          along_y(hn::Sub(hn::LoadU(Tag(), edges.end_y + i), start_y)) {}
};

/// Squared distances of points from edges, lane by lane.
HWY_INLINE Lanes squared_distances(const EdgesAlong& edges, Lanes x, Lanes y) {
    const Tag tag;
    const Lanes to_x = hn::Sub(x, edges.start_x);
    const Lanes to_y = hn::Sub(y, edges.start_y);
    const Lanes of_length = hn::Mul(
        hn::Add(hn::Mul(edges.along_x, to_x), hn::Mul(edges.along_y, to_y)), edges.inverse_length);
    // NaN (an edge so short that its inverse is infinite) becomes 0.
    const Lanes not_before = hn::IfThenElseZero(hn::Gt(of_length, hn::Zero(tag)), of_length);
    const Lanes parameter = hn::Min(not_before, hn::Set(tag, 1.0));
    const Lanes off_x = hn::Sub(to_x, hn::Mul(parameter, edges.along_x));
    const Lanes off_y = hn::Sub(to_y, hn::Mul(parameter, edges.along_y));
    return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
}

/// The lane with the least value; of equal ones the one with the least index.
HWY_INLINE NearEdge min_of(Lanes values, Lanes indices) {
    const Tag tag;
    const Lanes infinity = hn::Set(tag, std::numeric_limits<double>::infinity());
    const double least = min_lane(values);
    const LaneMask is_least = hn::Eq(values, hn::Set(tag, least));
    return {static_cast<std::uint32_t>(min_lane(hn::IfThenElse(is_least, indices, infinity))),
            least};
}

HWY_INLINE LaneMask meet(const LanesOfExtent& box, const EdgeLanes& edges) {
    return hn::And(hn::And(hn::Le(hn::Min(edges.start_x, edges.end_x), box.high_x),
                           hn::Ge(hn::Max(edges.start_x, edges.end_x), box.low_x)),
                   hn::And(hn::Le(hn::Min(edges.start_y, edges.end_y), box.high_y),
                           hn::Ge(hn::Max(edges.start_y, edges.end_y), box.low_y)));
}

/// The z components of the cross products.
HWY_INLINE Lanes cross_lanes(Lanes ax, Lanes ay, Lanes bx, Lanes by) {
    return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

/// True if both values are beyond `reach` on the same side.
HWY_INLINE LaneMask beyond(Lanes one, Lanes other, Lanes reach) {
    return hn::Or(hn::Gt(hn::Min(one, other), reach), hn::Lt(hn::Max(one, other), hn::Neg(reach)));
}

/// Tests one edge against others: false if either lies to one side of the other's line.
HWY_INLINE LaneMask may_meet(const EdgeArrays& first, std::size_t edge, const EdgeLanes& second,
                             double margin) {
    const Tag tag;
    const Lanes start_x = hn::Set(tag, first.start_x[edge]);
    const Lanes start_y = hn::Set(tag, first.start_y[edge]);
    const Lanes end_x = hn::Set(tag, first.end_x[edge]);
    const Lanes end_y = hn::Set(tag, first.end_y[edge]);
    const Lanes close = hn::Set(tag, margin);
    const Lanes x = hn::Sub(end_x, start_x);
    const Lanes y = hn::Sub(end_y, start_y);
    const Lanes other_x = hn::Sub(second.end_x, second.start_x);
    const Lanes other_y = hn::Sub(second.end_y, second.start_y);
    // The sum of the coordinates bounds the length from above and needs no square root.
    const LaneMask beside_first = beyond(
        cross_lanes(x, y, hn::Sub(second.start_x, start_x), hn::Sub(second.start_y, start_y)),
        cross_lanes(x, y, hn::Sub(second.end_x, start_x), hn::Sub(second.end_y, start_y)),
        hn::Mul(close, hn::Add(hn::Abs(x), hn::Abs(y))));
    const LaneMask beside_second =
        beyond(cross_lanes(other_x, other_y, hn::Sub(start_x, second.start_x),
                           hn::Sub(start_y, second.start_y)),
               cross_lanes(other_x, other_y, hn::Sub(end_x, second.start_x),
                           hn::Sub(end_y, second.start_y)),
               hn::Mul(close, hn::Add(hn::Abs(other_x), hn::Abs(other_y))));
    return hn::Not(hn::Or(beside_first, beside_second));
}

HWY_INLINE Extent extent_of(const EdgeArrays& edges, std::size_t edge, double margin) {
    const double start_x = edges.start_x[edge];
    const double start_y = edges.start_y[edge];
    const double end_x = edges.end_x[edge];
    const double end_y = edges.end_y[edge];
    return {
        (start_x < end_x ? start_x : end_x) - margin, (start_y < end_y ? start_y : end_y) - margin,
        (start_x < end_x ? end_x : start_x) + margin, (start_y < end_y ? end_y : start_y) + margin};
}

// Defined in edge_kernels.cpp, for other kernels of the same instruction set.

/// The squared distance of a point from the nearest edge, up to rounding.
double LeastSquared(const EdgeArrays& edges, double point_x, double point_y);
std::uint32_t FindEdgesWithin(const EdgeArrays& edges, double point_x, double point_y, double most,
                              std::uint32_t* found);

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
