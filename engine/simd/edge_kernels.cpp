#include <engine/simd/edge_kernels.hpp>

#include <algorithm>
#include <bit>
#include <limits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/edge_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

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

HWY_INLINE LaneMask are_in(const LanesOfExtent& box, Lanes x, Lanes y) {
    return hn::And(hn::And(hn::Ge(x, box.low_x), hn::Le(x, box.high_x)),
                   hn::And(hn::Ge(y, box.low_y), hn::Le(y, box.high_y)));
}

/// Appends the points that pass `test`; input and output may be the same arrays.
template <class Test>
HWY_INLINE std::uint32_t append_points_that(const PointArrays& points, const Test& test,
                                            const FoundPoints& found) {
    std::uint32_t count = 0;
    for_each_that(0, points.count, test, [&](std::size_t i) HWY_ATTR {
        found.x[count] = points.x[i];
        found.y[count] = points.y[i];
        ++count;
    });
    return count;
}

std::uint32_t FindPointsIn(const PointArrays& points, const Extent& box, const FoundPoints& found) {
    const LanesOfExtent bounds = lanes_of(box);
    return append_points_that(
        points,
        [&](std::size_t i) HWY_ATTR {
            const Tag tag;
            return are_in(bounds, hn::LoadU(tag, points.x + i), hn::LoadU(tag, points.y + i));
        },
        found);
}

bool Contain(const EdgeArrays& edges, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    Lanes odd = hn::Zero(tag);
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        odd = hn::Xor(odd, crossings(EdgeLanes(edges, i), x, y));
    }
    return (std::popcount(bits_of(are_negative(odd))) & 1) != 0;
}

std::uint32_t FindEdgesIn(const EdgeArrays& edges, const Extent& box, std::uint32_t* found) {
    const LanesOfExtent bounds = lanes_of(box);
    return append_those_that(
        0, edges.count, [&](std::size_t i) HWY_ATTR { return meet(bounds, EdgeLanes(edges, i)); },
        found, 0);
}

/// Keeps the found points that are inside.
std::uint32_t KeepInside(std::uint32_t count, const EdgeArrays& edges, std::uint32_t* crossed,
                         const FoundPoints& found) {
    const PointArrays points{count, found.x, found.y};
    // Rays to the right cross only edges whose boxes intersect this box.
    Extent rays = extent_of(points, 0);
    rays.high_x = std::numeric_limits<double>::infinity();
    const std::uint32_t beside = FindEdgesIn(edges, rays, crossed);
    return append_points_that(
        points,
        [&](std::size_t i) HWY_ATTR {
            const Tag tag;
            const Lanes x = hn::LoadU(tag, points.x + i);
            const Lanes y = hn::LoadU(tag, points.y + i);
            Lanes odd = hn::Zero(tag);
            for (std::uint32_t k = 0; k < beside; ++k) {
                odd = hn::Xor(odd, crossings(EdgeLanes::Same(edges, crossed[k]), x, y));
            }
            return are_negative(odd);
        },
        found);
}

std::uint32_t FindPointsInside(const PointArrays& points, const Extent& box,
                               const EdgeArrays& edges, std::uint32_t* crossed,
                               const FoundPoints& found) {
    // For this few points, testing one point against several edges at once is faster than several
    // points against one edge.
    constexpr std::uint32_t few_points = 4;
    const std::uint32_t in_box = FindPointsIn(points, box, found);
    if (in_box > few_points) {
        return KeepInside(in_box, edges, crossed, found);
    }
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < in_box; ++i) {
        const double x = found.x[i];
        const double y = found.y[i];
        found.x[count] = x;
        found.y[count] = y;
        count += Contain(edges, x, y) ? 1U : 0U;
    }
    return count;
}

/// Squared distances of a point from the edges i, i + 1, ...
HWY_INLINE Lanes squared_distances(const EdgeArrays& edges, std::size_t i, Lanes x, Lanes y) {
    EdgesAlong along(edges, i);
    along.inverse_length = hn::LoadU(Tag(), edges.inverse_length + i);
    return squared_distances(along, x, y);
}

NearestOfEdges FindNearest(const EdgeArrays& edges, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    Lanes index = hn::Iota(tag, 0.0);
    Lanes least = squared_distances(edges, 0, x, y);
    Lanes second = hn::Set(tag, std::numeric_limits<double>::infinity());
    Lanes nearest = index;
    const Lanes step = hn::Set(tag, static_cast<double>(hn::Lanes(tag)));
    for (std::size_t i = hn::Lanes(tag); i < edges.count; i += hn::Lanes(tag)) {
        index = hn::Add(index, step);
        const Lanes squared = squared_distances(edges, i, x, y);
        const LaneMask nearer = hn::Lt(squared, least);
        second = hn::Min(second, hn::Max(squared, least));
        least = hn::Min(least, squared);
        nearest = hn::IfThenElse(nearer, index, nearest);
    }
    const NearEdge found = min_of(least, nearest);
    const LaneMask is_found = hn::Eq(nearest, hn::Set(tag, static_cast<double>(found.edge)));
    // Padding lanes are no nearer than the last edge, but may appear so by rounding.
    return {{found.edge < edges.count ? found.edge : edges.count - 1, found.squared},
            min_lane(hn::IfThenElse(is_found, second, least))};
}

double LeastSquared(const EdgeArrays& edges, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    Lanes least = squared_distances(edges, 0, x, y);
    for (std::size_t i = hn::Lanes(tag); i < edges.count; i += hn::Lanes(tag)) {
        least = hn::Min(least, squared_distances(edges, i, x, y));
    }
    return min_lane(least);
}

std::uint32_t FindEdgesWithin(const EdgeArrays& edges, double point_x, double point_y, double most,
                              std::uint32_t* found) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    const Lanes limit = hn::Set(tag, most);
    return append_those_that(
        0, edges.count,
        [&](std::size_t i) HWY_ATTR { return hn::Le(squared_distances(edges, i, x, y), limit); },
        found, 0);
}

bool FindIntersectingPair(const EdgeArrays& first, const EdgeArrays& second, double margin,
                          EdgePair& pair) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::uint32_t i = pair.first; i < first.count; ++i) {
        // Twice the margin, because the values that two boxes are compared by are rounded too.
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

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindInverseLengths);
HWY_EXPORT(FindPointsIn);
HWY_EXPORT(FindPointsInside);
HWY_EXPORT(Contain);
HWY_EXPORT(FindNearest);
HWY_EXPORT(FindEdgesWithin);
HWY_EXPORT(FindEdgesIn);
HWY_EXPORT(FindIntersectingPair);

void find_inverse_lengths(const EdgeArrays& edges, double* inverse_length) {
    HWY_DYNAMIC_DISPATCH(FindInverseLengths)(edges, inverse_length);
}

std::uint32_t find_points_in(const PointArrays& points, const Extent& box,
                             const FoundPoints& found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsIn)(points, box, found);
}

std::uint32_t find_points_inside(const PointArrays& points, const Extent& box,
                                 const EdgeArrays& edges, std::uint32_t* crossed,
                                 const FoundPoints& found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsInside)(points, box, edges, crossed, found);
}

bool contain(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(Contain)(edges, x, y);
}

NearestOfEdges find_nearest(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(FindNearest)(edges, x, y);
}

std::uint32_t find_edges_within(const EdgeArrays& edges, double x, double y, double most,
                                std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesWithin)(edges, x, y, most, found);
}

std::uint32_t find_edges_in(const EdgeArrays& edges, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesIn)(edges, box, found);
}

bool find_intersecting_pair(const EdgeArrays& first, const EdgeArrays& second, double margin,
                            EdgePair& pair) {
    return HWY_DYNAMIC_DISPATCH(FindIntersectingPair)(first, second, margin, pair);
}

}  // namespace nearfield::simd::kernels
#endif
