#include <engine/geometry/clip.hpp>
#include <engine/plan/edge_stack.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/plan/edge_stack.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/geometry/float_arrays-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::plan::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using geometry::HWY_NAMESPACE::copy_kept;

using Floats = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

struct NearEdges {
    Vector start_x, start_y, along_x, along_y, inverse;
};

HWY_INLINE NearEdges load(const EdgeStack& edges, std::size_t i) {
    const Floats d;
    return {hn::LoadU(d, edges.number(EdgeStack::start_x) + i),
            hn::LoadU(d, edges.number(EdgeStack::start_y) + i),
            hn::LoadU(d, edges.number(EdgeStack::along_x) + i),
            hn::LoadU(d, edges.number(EdgeStack::along_y) + i),
            hn::LoadU(d, edges.number(EdgeStack::inverse) + i)};
}

float measure_squared(const EdgeStack& edges, std::size_t first, std::size_t end, float x, float y,
                      float* squared) {
    const Floats d;
    Vector nearest = hn::Set(d, std::numeric_limits<float>::max());
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const NearEdges some = load(edges, i);
        // Nothing is fused: the same bits on every machine.
        const Vector to_x = hn::Sub(hn::Set(d, x), some.start_x);
        const Vector to_y = hn::Sub(hn::Set(d, y), some.start_y);
        Vector t = hn::Mul(hn::Add(hn::Mul(to_x, some.along_x), hn::Mul(to_y, some.along_y)),
                           some.inverse);
        t = hn::Min(hn::Max(t, hn::Zero(d)), hn::Set(d, 1.0F));
        const Vector away_x = hn::Sub(to_x, hn::Mul(t, some.along_x));
        const Vector away_y = hn::Sub(to_y, hn::Mul(t, some.along_y));
        const Vector distance = hn::Add(hn::Mul(away_x, away_x), hn::Mul(away_y, away_y));
        hn::StoreU(distance, d, squared + i);
        nearest = hn::IfThenElse(hn::FirstN(d, end - i), hn::Min(nearest, distance), nearest);
    }
    return hn::GetLane(hn::MinOfLanes(d, nearest));
}

void push_within(EdgeStack& edges, std::size_t first, std::size_t end, const float* squared,
                 float limit) {
    const Floats d;
    std::size_t pushed = edges.size();
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const Mask near =
            hn::And(hn::FirstN(d, end - i), hn::Le(hn::LoadU(d, squared + i), hn::Set(d, limit)));
        pushed += copy_kept(d, edges, i, near, edges, pushed);
    }
    edges.resize(pushed);
}

}  // namespace
}  // namespace nearfield::plan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::plan {
namespace {

/// Edges shorter than this, in cells, count as points: a division by their squared length would
/// overflow single precision.
constexpr double shortest_edge = 1e-15;

}  // namespace

HWY_EXPORT(measure_squared);
HWY_EXPORT(push_within);

double push_part(const geometry::Vector& a, const geometry::Vector& b, double window,
                 std::uint32_t index, EdgeStack& edges) {
    geometry::Vector start = a;
    geometry::Vector end = b;
    for (const int axis : {0, 1}) {
        static_cast<void>(geometry::clip_to_slab(start, end, axis, -window, window));
    }
    const geometry::Vector along = end - start;
    const double squared = along.squaredNorm();
    const bool is_point = squared < shortest_edge * shortest_edge;
    edges.push({static_cast<float>(start.x()), static_cast<float>(start.y()),
                static_cast<float>(along.x()), static_cast<float>(along.y()),
                static_cast<float>(is_point ? 0.0 : 1.0 / squared)},
               index);
    return is_point ? 0.0 : squared;
}

float measure_squared(const EdgeStack& edges, std::size_t first, std::size_t end, float x, float y,
                      float* squared) {
    return HWY_DYNAMIC_DISPATCH(measure_squared)(edges, first, end, x, y, squared);
}

void push_within(EdgeStack& edges, std::size_t first, std::size_t end, const float* squared,
                 float limit) {
    edges.reserve(end - first);
    HWY_DYNAMIC_DISPATCH(push_within)(edges, first, end, squared, limit);
}

}  // namespace nearfield::plan
#endif
