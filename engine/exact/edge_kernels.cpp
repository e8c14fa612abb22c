#include <engine/exact/edge_kernels.hpp>

#include <bit>
#include <cstring>
#include <limits>

// Highway compiles what follows once for every instruction set, by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/exact/edge_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::exact::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, most_lanes>;
using Lanes = hn::Vec<Tag>;
using LaneMask = hn::Mask<Tag>;

/// One bit a lane, the first lane lowest.
HWY_INLINE std::uint32_t bits_of(LaneMask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return bits[0];
}

/// Appends the lanes that are set to a list of indices, but for those from `end` on.
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

HWY_INLINE double least_lane(Lanes lanes) {
    return hn::GetLane(hn::MinOfLanes(Tag(), lanes));
}

HWY_INLINE double greatest_lane(Lanes lanes) {
    return hn::GetLane(hn::MaxOfLanes(Tag(), lanes));
}

struct PlacedPoints {
    Lanes x;
    Lanes y;
};

HWY_INLINE PlacedPoints place_lanes(const double* interleaved, const Placement& placement) {
    const Tag tag;
    Lanes x;
    Lanes y;
    hn::LoadInterleaved2(tag, interleaved, x, y);
    const auto placed = [&](int axis) HWY_ATTR {
        const Lanes turned = hn::Add(hn::Mul(hn::Set(tag, placement.x_axis[axis]), x),
                                     hn::Mul(hn::Set(tag, placement.y_axis[axis]), y));
        return hn::Add(turned, hn::Set(tag, placement.translation[axis]));
    };
    return {placed(0), placed(1)};
}

Extent PlacePoints(const double* interleaved, std::uint32_t count, const Placement& placement,
                   double* x, double* y) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    double padded_points[2 * most_lanes];
    if (count < lanes) {
        for (std::size_t i = 0; i < lanes; ++i) {
            std::memcpy(padded_points + 2 * i, interleaved + 2 * (i < count ? i : 0),
                        2 * sizeof(double));
        }
        interleaved = padded_points;
    }
    Lanes low_x = hn::Set(tag, std::numeric_limits<double>::infinity());
    Lanes low_y = low_x;
    Lanes high_x = hn::Neg(low_x);
    Lanes high_y = high_x;
    const auto place_at = [&](std::size_t i) HWY_ATTR {
        const PlacedPoints placed = place_lanes(interleaved + 2 * i, placement);
        low_x = hn::Min(low_x, placed.x);
        low_y = hn::Min(low_y, placed.y);
        high_x = hn::Max(high_x, placed.x);
        high_y = hn::Max(high_y, placed.y);
        return placed;
    };
    if (count < lanes) {
        const PlacedPoints placed = place_at(0);
        double placed_x[most_lanes];
        double placed_y[most_lanes];
        hn::StoreU(placed.x, tag, placed_x);
        hn::StoreU(placed.y, tag, placed_y);
        std::memcpy(x, placed_x, count * sizeof(double));
        std::memcpy(y, placed_y, count * sizeof(double));
    } else {
        for (std::size_t i = 0; i < count; i += lanes) {
            // The last lanes may hold some of the points before once more.
            const std::size_t from = i + lanes <= count ? i : count - lanes;
            const PlacedPoints placed = place_at(from);
            hn::StoreU(placed.x, tag, x + from);
            hn::StoreU(placed.y, tag, y + from);
        }
    }
    return {least_lane(low_x), least_lane(low_y), greatest_lane(high_x), greatest_lane(high_y)};
}

void FindInverseLengths(const EdgeArrays& edges, double* inverse_length) {
    const Tag tag;
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        const Lanes x = hn::Sub(hn::LoadU(tag, edges.end_x + i), hn::LoadU(tag, edges.start_x + i));
        const Lanes y = hn::Sub(hn::LoadU(tag, edges.end_y + i), hn::LoadU(tag, edges.start_y + i));
        const Lanes squared = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
        const Lanes inverse = hn::Div(hn::Set(tag, 1.0), squared);
        hn::StoreU(hn::IfThenElseZero(hn::Gt(squared, hn::Zero(tag)), inverse), tag,
                   inverse_length + i);
    }
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

HWY_INLINE LaneMask are_in(const LanesOfExtent& box, Lanes x, Lanes y) {
    return hn::And(hn::And(hn::Ge(x, box.low_x), hn::Le(x, box.high_x)),
                   hn::And(hn::Ge(y, box.low_y), hn::Le(y, box.high_y)));
}

std::uint32_t FindPointsIn(const PointArrays& points, const Extent& box, std::uint32_t* found) {
    const Tag tag;
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(tag)) {
        const LaneMask inside =
            are_in(bounds, hn::LoadU(tag, points.x + i), hn::LoadU(tag, points.y + i));
        count = append_lanes(inside, i, points.count, found, count);
    }
    return count;
}

/// By the sign bit, whatever the rest.
HWY_INLINE LaneMask are_negative(Lanes lanes) {
    const Tag tag;
    const hn::RebindToSigned<Tag> whole;
    return hn::RebindMask(tag, hn::Lt(hn::BitCast(whole, lanes), hn::Zero(whole)));
}

bool Contain(const EdgeArrays& edges, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    // Only signs count; a difference is negative just where the comparison holds.
    Lanes odd = hn::Zero(tag);
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        const Lanes start_x = hn::LoadU(tag, edges.start_x + i);
        const Lanes start_y = hn::LoadU(tag, edges.start_y + i);
        const Lanes end_x = hn::LoadU(tag, edges.end_x + i);
        const Lanes end_y = hn::LoadU(tag, edges.end_y + i);
        const Lanes start_above = hn::Sub(y, start_y);
        const Lanes end_above = hn::Sub(y, end_y);
        const Lanes left = hn::Sub(hn::Mul(hn::Sub(end_y, start_y), hn::Sub(x, start_x)),
                                   hn::Mul(hn::Sub(end_x, start_x), start_above));
        // Left of an edge that goes up, right of one that goes down: the ray to the right hits it.
        const Lanes hit = hn::AndNot(hn::Xor(left, end_above), hn::Xor(start_above, end_above));
        odd = hn::Xor(odd, hit);
    }
    return (std::popcount(bits_of(are_negative(odd))) & 1) != 0;
}

std::uint32_t FindPointsInside(const PointArrays& points, const Extent& box,
                               const EdgeArrays& edges, std::uint32_t* found) {
    const std::uint32_t in_box = FindPointsIn(points, box, found);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < in_box; ++i) {
        const std::uint32_t point = found[i];
        found[count] = point;
        count += Contain(edges, points.x[point], points.y[point]) ? 1U : 0U;
    }
    return count;
}

/// Of a point to the edges i, i + 1, ...
HWY_INLINE Lanes squared_distances(const EdgeArrays& edges, std::size_t i, Lanes x, Lanes y) {
    const Tag tag;
    const Lanes start_x = hn::LoadU(tag, edges.start_x + i);
    const Lanes start_y = hn::LoadU(tag, edges.start_y + i);
    const Lanes along_x = hn::Sub(hn::LoadU(tag, edges.end_x + i), start_x);
    const Lanes along_y = hn::Sub(hn::LoadU(tag, edges.end_y + i), start_y);
    const Lanes to_x = hn::Sub(x, start_x);
    const Lanes to_y = hn::Sub(y, start_y);
    const Lanes of_length = hn::Mul(hn::Add(hn::Mul(along_x, to_x), hn::Mul(along_y, to_y)),
                                    hn::LoadU(tag, edges.inverse_length + i));
    // What is no number (an edge so short that its inverse is infinite) becomes 0.
    const Lanes not_before = hn::IfThenElseZero(hn::Gt(of_length, hn::Zero(tag)), of_length);
    const Lanes parameter = hn::Min(not_before, hn::Set(tag, 1.0));
    const Lanes off_x = hn::Sub(to_x, hn::Mul(parameter, along_x));
    const Lanes off_y = hn::Sub(to_y, hn::Mul(parameter, along_y));
    return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
}

/// The lane of the least value, of equal ones the one of the least index.
HWY_INLINE NearEdge least_of(Lanes values, Lanes indices) {
    const Tag tag;
    const Lanes infinity = hn::Set(tag, std::numeric_limits<double>::infinity());
    const double least = least_lane(values);
    const LaneMask is_least = hn::Eq(values, hn::Set(tag, least));
    return {static_cast<std::uint32_t>(least_lane(hn::IfThenElse(is_least, indices, infinity))),
            least};
}

NearEdge FindNearest(const EdgeArrays& edges, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    Lanes index = hn::Iota(tag, 0.0);
    Lanes least = squared_distances(edges, 0, x, y);
    Lanes nearest = index;
    const Lanes step = hn::Set(tag, static_cast<double>(hn::Lanes(tag)));
    for (std::size_t i = hn::Lanes(tag); i < edges.count; i += hn::Lanes(tag)) {
        index = hn::Add(index, step);
        const Lanes squared = squared_distances(edges, i, x, y);
        const LaneMask nearer = hn::Lt(squared, least);
        least = hn::IfThenElse(nearer, squared, least);
        nearest = hn::IfThenElse(nearer, index, nearest);
    }
    NearEdge found = least_of(least, nearest);
    // What fills up the lanes is no nearer than the last edge, but may be so by its rounding.
    found.edge = found.edge < edges.count ? found.edge : edges.count - 1;
    return found;
}

void FindNearestOf(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                   const EdgeArrays& edges, NearEdge* nearest) {
    for (std::uint32_t i = 0; i < count; ++i) {
        nearest[i] = FindNearest(edges, points.x[listed[i]], points.y[listed[i]]);
    }
}

std::uint32_t FindEdgesWithin(const EdgeArrays& edges, double point_x, double point_y, double most,
                              std::uint32_t* found) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    const Lanes limit = hn::Set(tag, most);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        count = append_lanes(hn::Le(squared_distances(edges, i, x, y), limit), i, edges.count,
                             found, count);
    }
    return count;
}

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
};

HWY_INLINE LaneMask meet(const LanesOfExtent& box, const EdgeLanes& edges) {
    return hn::And(hn::And(hn::Le(hn::Min(edges.start_x, edges.end_x), box.high_x),
                           hn::Ge(hn::Max(edges.start_x, edges.end_x), box.low_x)),
                   hn::And(hn::Le(hn::Min(edges.start_y, edges.end_y), box.high_y),
                           hn::Ge(hn::Max(edges.start_y, edges.end_y), box.low_y)));
}

std::uint32_t FindEdgesIn(const EdgeArrays& edges, const Extent& box, std::uint32_t* found) {
    const Tag tag;
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        count = append_lanes(meet(bounds, EdgeLanes(edges, i)), i, edges.count, found, count);
    }
    return count;
}

/// The z component of the cross products.
HWY_INLINE Lanes cross_lanes(Lanes ax, Lanes ay, Lanes bx, Lanes by) {
    return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

/// True where both values are beyond the reach, on one side.
HWY_INLINE LaneMask beyond(Lanes one, Lanes other, Lanes reach) {
    return hn::Or(hn::Gt(hn::Min(one, other), reach), hn::Lt(hn::Max(one, other), hn::Neg(reach)));
}

/// One edge against the edges i, i + 1, ...: false where either lies beside the other's line.
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
    // The sum of the coordinates is no less than the length, and costs no root.
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

bool FindMeetingPair(const EdgeArrays& first, const EdgeArrays& second, double margin,
                     EdgePair& pair) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::uint32_t i = pair.first; i < first.count; ++i) {
        // Twice the margin: what two boxes are compared by rounds too.
        const LanesOfExtent box = lanes_of(extent_of(first, i, 2.0 * margin));
        const std::uint32_t from = i == pair.first ? pair.second : 0;
        for (std::size_t j = from / lanes * lanes; j < second.count; j += lanes) {
            const EdgeLanes others(second, j);
            const LaneMask near = meet(box, others);
            if (hn::AllFalse(tag, near)) {
                continue;
            }
            std::uint32_t bits = bits_of(hn::And(near, may_meet(first, i, others, margin)));
            bits &= j < from ? ~0U << (from - j) : ~0U;
            if (bits != 0) {
                const auto found = static_cast<std::uint32_t>(j) +
                                   static_cast<std::uint32_t>(std::countr_zero(bits));
                if (found < second.count) {
                    pair = {i, found};
                    return true;
                }
            }
        }
    }
    return false;
}

/// Of points to a box; 0 inside.
HWY_INLINE Lanes squared_to(const LanesOfExtent& box, Lanes x, Lanes y) {
    const Lanes zero = hn::Zero(Tag());
    const Lanes off_x = hn::Max(hn::Max(hn::Sub(box.low_x, x), hn::Sub(x, box.high_x)), zero);
    const Lanes off_y = hn::Max(hn::Max(hn::Sub(box.low_y, y), hn::Sub(y, box.high_y)), zero);
    return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
}

std::uint32_t FindPointNearestTo(const PointArrays& points, const Extent& box) {
    const Tag tag;
    const LanesOfExtent bounds = lanes_of(box);
    Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
    Lanes index = hn::Iota(tag, 0.0);
    Lanes nearest = index;
    const Lanes step = hn::Set(tag, static_cast<double>(hn::Lanes(tag)));
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(tag)) {
        const Lanes squared =
            squared_to(bounds, hn::LoadU(tag, points.x + i), hn::LoadU(tag, points.y + i));
        const LaneMask nearer = hn::Lt(squared, least);
        least = hn::IfThenElse(nearer, squared, least);
        nearest = hn::IfThenElse(nearer, index, nearest);
        index = hn::Add(index, step);
    }
    const std::uint32_t found = least_of(least, nearest).edge;
    return found < points.count ? found : points.count - 1;
}

std::uint32_t FindPointsWithin(const PointArrays& points, const Extent& box, double most,
                               std::uint32_t* found) {
    const Tag tag;
    const LanesOfExtent bounds = lanes_of(box);
    const Lanes limit = hn::Set(tag, most);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(tag)) {
        const Lanes squared =
            squared_to(bounds, hn::LoadU(tag, points.x + i), hn::LoadU(tag, points.y + i));
        count = append_lanes(hn::Le(squared, limit), i, points.count, found, count);
    }
    return count;
}

void FindDistances(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                   const EdgeArrays& edges, double* squared) {
    const Tag tag;
    for (std::uint32_t k = 0; k < count; ++k) {
        const Lanes x = hn::Set(tag, points.x[listed[k]]);
        const Lanes y = hn::Set(tag, points.y[listed[k]]);
        Lanes least = squared_distances(edges, 0, x, y);
        for (std::size_t i = hn::Lanes(tag); i < edges.count; i += hn::Lanes(tag)) {
            least = hn::Min(least, squared_distances(edges, i, x, y));
        }
        squared[k] = least_lane(least);
    }
}

}  // namespace nearfield::exact::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::exact::kernels {

HWY_EXPORT(PlacePoints);
HWY_EXPORT(FindInverseLengths);
HWY_EXPORT(FindPointsIn);
HWY_EXPORT(FindPointsInside);
HWY_EXPORT(Contain);
HWY_EXPORT(FindNearest);
HWY_EXPORT(FindNearestOf);
HWY_EXPORT(FindEdgesWithin);
HWY_EXPORT(FindEdgesIn);
HWY_EXPORT(FindMeetingPair);
HWY_EXPORT(FindPointNearestTo);
HWY_EXPORT(FindPointsWithin);
HWY_EXPORT(FindDistances);

Extent place_points(const double* interleaved, std::uint32_t count, const Placement& placement,
                    double* x, double* y) {
    return HWY_DYNAMIC_DISPATCH(PlacePoints)(interleaved, count, placement, x, y);
}

void find_inverse_lengths(const EdgeArrays& edges, double* inverse_length) {
    HWY_DYNAMIC_DISPATCH(FindInverseLengths)(edges, inverse_length);
}

std::uint32_t find_points_in(const PointArrays& points, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsIn)(points, box, found);
}

std::uint32_t find_points_inside(const PointArrays& points, const Extent& box,
                                 const EdgeArrays& edges, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsInside)(points, box, edges, found);
}

bool contain(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(Contain)(edges, x, y);
}

NearEdge find_nearest(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(FindNearest)(edges, x, y);
}

void find_nearest_of(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                     const EdgeArrays& edges, NearEdge* nearest) {
    HWY_DYNAMIC_DISPATCH(FindNearestOf)(points, listed, count, edges, nearest);
}

std::uint32_t find_edges_within(const EdgeArrays& edges, double x, double y, double most,
                                std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesWithin)(edges, x, y, most, found);
}

std::uint32_t find_edges_in(const EdgeArrays& edges, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesIn)(edges, box, found);
}

bool find_meeting_pair(const EdgeArrays& first, const EdgeArrays& second, double margin,
                       EdgePair& pair) {
    return HWY_DYNAMIC_DISPATCH(FindMeetingPair)(first, second, margin, pair);
}

std::uint32_t find_point_nearest_to(const PointArrays& points, const Extent& box) {
    return HWY_DYNAMIC_DISPATCH(FindPointNearestTo)(points, box);
}

std::uint32_t find_points_within(const PointArrays& points, const Extent& box, double most,
                                 std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsWithin)(points, box, most, found);
}

void find_distances(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                    const EdgeArrays& edges, double* squared) {
    HWY_DYNAMIC_DISPATCH(FindDistances)(points, listed, count, edges, squared);
}

}  // namespace nearfield::exact::kernels
#endif
