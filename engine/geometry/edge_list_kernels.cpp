#include <engine/geometry/edge_list_kernels.hpp>

#include <limits>

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/geometry/edge_list_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/geometry/edge_list-inl.hpp>
#include <engine/geometry/float_arrays-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Floats>;

float measure_squared(const EdgeList& edges, std::size_t first, std::size_t end, float x, float y,
                      float* squared) {
    const Floats d;
    Vector least = hn::Set(d, std::numeric_limits<float>::infinity());
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const auto number = [&](std::size_t which) {
            return hn::LoadU(d, edges.number(which) + i);
        };
        const Vector distance = away_from(d, number, hn::Set(d, x), hn::Set(d, y)).squared();
        hn::StoreU(distance, d, squared + i);
        // Lanes beyond the last edge are arbitrary.
        least = hn::IfThenElse(hn::FirstN(d, end - i), hn::Min(least, distance), least);
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
}

std::size_t copy_within(const EdgeList& from, std::size_t first, std::size_t end,
                        const float* squared, float limit, EdgeList& to) {
    const Floats d;
    std::size_t size = to.size();
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const auto near =
            hn::And(hn::FirstN(d, end - i), hn::Le(hn::LoadU(d, squared + i), hn::Set(d, limit)));
        size += copy_kept(d, from, i, near, to, size);
    }
    return size;
}

}  // namespace
}  // namespace nearfield::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::geometry {
namespace {

/// Edges shorter than this, in cells, count as points: division by their squared length would
/// overflow single precision.
constexpr double shortest_edge = 1e-12;

}  // namespace

HWY_EXPORT(measure_squared);
HWY_EXPORT(copy_within);

double push_edge(const Vector& start, const Vector& end, std::uint32_t index, EdgeList& edges) {
    const Vector along = end - start;
    const double squared = along.squaredNorm();
    const bool is_point = squared < shortest_edge * shortest_edge;
    const double inverse = is_point ? 0.0 : 1.0 / squared;
    const double length = is_point ? 0.0 : 1.0;
    edges.push({static_cast<float>(start.x()), static_cast<float>(start.y()),
                static_cast<float>(length * along.x()), static_cast<float>(length * along.y()),
                static_cast<float>(along.x() * inverse), static_cast<float>(along.y() * inverse)},
               index);
    return length * squared;
}

float measure_squared(const EdgeList& edges, std::size_t first, std::size_t end, float x, float y,
                      float* squared) {
    return HWY_DYNAMIC_DISPATCH(measure_squared)(edges, first, end, x, y, squared);
}

void push_within(const EdgeList& from, std::size_t first, std::size_t end, const float* squared,
                 float limit, EdgeList& to) {
    to.reserve(end - first);
    to.resize(HWY_DYNAMIC_DISPATCH(copy_within)(from, first, end, squared, limit, to));
}

}  // namespace nearfield::geometry
#endif
