#include <engine/exact/edge_kernels.hpp>

#include <algorithm>
#include <bit>
#include <limits>

// Highway compiles what follows once for every instruction set, by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/exact/edge_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/exact/lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::exact::kernels::HWY_NAMESPACE {

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
    const Tag tag;
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < edges.count; i += hn::Lanes(tag)) {
        count = append_lanes(meet(bounds, EdgeLanes(edges, i)), i, edges.count, found, count);
    }
    return count;
}

/// So many points are quicker held against several edges at once than several points against one.
constexpr std::uint32_t few_points = 4;

/// As many listed points as there are lanes; of fewer the last one fills the rest.
struct PointLanes {
    Lanes x;
    Lanes y;

    HWY_INLINE PointLanes(const PointArrays& points, const std::uint32_t* listed,
                          std::uint32_t count) {
        const Tag tag;
        HWY_ALIGN double of_x[most_lanes];
        HWY_ALIGN double of_y[most_lanes];
        for (std::uint32_t i = 0; i < hn::Lanes(tag); ++i) {
            const std::uint32_t point = listed[i < count ? i : count - 1];
            of_x[i] = points.x[point];
            of_y[i] = points.y[point];
        }
        x = hn::Load(tag, of_x);
        y = hn::Load(tag, of_y);
    }
};

/// The box around listed points; at least one.
Extent extent_of(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count) {
    Extent box{points.x[listed[0]], points.y[listed[0]], points.x[listed[0]], points.y[listed[0]]};
    for (std::uint32_t i = 1; i < count; ++i) {
        const double x = points.x[listed[i]];
        const double y = points.y[listed[i]];
        box = {std::min(box.low_x, x), std::min(box.low_y, y), std::max(box.high_x, x),
               std::max(box.high_y, y)};
    }
    return box;
}

std::uint32_t FindPointsInside(const PointArrays& points, const Extent& box,
                               const EdgeArrays& edges, std::uint32_t* found,
                               std::uint32_t* crossed) {
    const Tag tag;
    const std::uint32_t in_box = FindPointsIn(points, box, found);
    std::uint32_t count = 0;
    if (in_box <= few_points) {
        for (std::uint32_t i = 0; i < in_box; ++i) {
            const std::uint32_t point = found[i];
            found[count] = point;
            count += Contain(edges, points.x[point], points.y[point]) ? 1U : 0U;
        }
        return count;
    }
    // A ray to the right crosses no edges but those.
    Extent rays = extent_of(points, found, in_box);
    rays.high_x = std::numeric_limits<double>::infinity();
    const std::uint32_t beside = FindEdgesIn(edges, rays, crossed);
    for (std::uint32_t i = 0; i < in_box; i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
        const auto together = std::min(in_box - i, static_cast<std::uint32_t>(hn::Lanes(tag)));
        const PointLanes lanes(points, found + i, together);
        Lanes odd = hn::Zero(tag);
        for (std::uint32_t k = 0; k < beside; ++k) {
            odd = hn::Xor(odd, crossings(EdgeLanes::Same(edges, crossed[k]), lanes.x, lanes.y));
        }
        const std::uint32_t inside = bits_of(are_negative(odd));
        for (std::uint32_t k = 0; k < together; ++k) {
            found[count] = found[i + k];
            count += inside >> k & 1U;
        }
    }
    return count;
}

/// Of a point to the edges i, i + 1, ...
HWY_INLINE Lanes squared_distances(const EdgeArrays& edges, std::size_t i, Lanes x, Lanes y) {
    EdgesAlong along(edges, i);
    along.inverse_length = hn::LoadU(Tag(), edges.inverse_length + i);
    return squared_distances(along, x, y);
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

/// Of several points at once, one edge after the other.
class NearestOfLanes {
public:
    HWY_INLINE NearestOfLanes()
        : first_(hn::Set(Tag(), std::numeric_limits<double>::infinity())),
          second_(first_),
          third_(first_),
          first_edge_(hn::Zero(Tag())),
          second_edge_(hn::Zero(Tag())) {}

    HWY_INLINE void Look(Lanes squared, Lanes edge) {
        const LaneMask nearest = hn::Lt(squared, first_);
        const LaneMask second = hn::Lt(squared, second_);
        third_ = hn::Min(third_, hn::Max(second_, squared));
        second_ = hn::Min(second_, hn::Max(first_, squared));
        first_ = hn::Min(first_, squared);
        second_edge_ =
            hn::IfThenElse(nearest, first_edge_, hn::IfThenElse(second, edge, second_edge_));
        first_edge_ = hn::IfThenElse(nearest, edge, first_edge_);
    }

    HWY_INLINE void Write(std::uint32_t count, NearestEdges* nearest) const {
        const Tag tag;
        HWY_ALIGN double values[4][most_lanes];
        hn::Store(first_edge_, tag, values[0]);
        hn::Store(second_edge_, tag, values[1]);
        hn::Store(second_, tag, values[2]);
        hn::Store(third_, tag, values[3]);
        for (std::uint32_t i = 0; i < count; ++i) {
            nearest[i] = {static_cast<std::uint32_t>(values[0][i]),
                          static_cast<std::uint32_t>(values[1][i]), values[2][i], values[3][i]};
        }
    }

private:
    Lanes first_;
    Lanes second_;
    Lanes third_;
    Lanes first_edge_;
    Lanes second_edge_;
};

void FindNearestOf(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                   const EdgeArrays& edges, NearestEdges* nearest) {
    const Tag tag;
    if (count <= few_points) {
        for (std::uint32_t i = 0; i < count; ++i) {
            nearest[i] = {FindNearest(edges, points.x[listed[i]], points.y[listed[i]]).edge};
        }
        return;
    }
    for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
        const auto together = std::min(count - i, static_cast<std::uint32_t>(hn::Lanes(tag)));
        const PointLanes lanes(points, listed + i, together);
        NearestOfLanes search;
        for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
            search.Look(squared_distances(EdgesAlong::Same(edges, edge), lanes.x, lanes.y),
                        hn::Set(tag, static_cast<double>(edge)));
        }
        search.Write(together, nearest + i);
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

}  // namespace nearfield::exact::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::exact::kernels {

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

void find_inverse_lengths(const EdgeArrays& edges, double* inverse_length) {
    HWY_DYNAMIC_DISPATCH(FindInverseLengths)(edges, inverse_length);
}

std::uint32_t find_points_in(const PointArrays& points, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindPointsIn)(points, box, found);
}

std::uint32_t find_points_inside(const PointArrays& points, const Extent& box,
                                 const EdgeArrays& edges, std::uint32_t* found,
                                 std::uint32_t* crossed) {
    return HWY_DYNAMIC_DISPATCH(FindPointsInside)(points, box, edges, found, crossed);
}

bool contain(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(Contain)(edges, x, y);
}

NearEdge find_nearest(const EdgeArrays& edges, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(FindNearest)(edges, x, y);
}

void find_nearest_of(const PointArrays& points, const std::uint32_t* listed, std::uint32_t count,
                     const EdgeArrays& edges, NearestEdges* nearest) {
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

}  // namespace nearfield::exact::kernels
#endif
