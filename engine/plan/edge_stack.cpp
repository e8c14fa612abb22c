#include <engine/geometry/clip.hpp>
#include <engine/plan/edge_stack.hpp>

#include <algorithm>
#include <array>
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
using Words = hn::RebindToUnsigned<Floats>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

constexpr std::size_t corners = 4;
constexpr std::array<float, corners> corner_x{-1.0F, 1.0F, -1.0F, 1.0F};
constexpr std::array<float, corners> corner_y{-1.0F, -1.0F, 1.0F, 1.0F};
constexpr std::size_t places = corners + 1;  // and the centre

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

/// Vector to a place from the point of an edge that is nearest to it.
struct WayFrom {
    Vector x;
    Vector y;

    [[nodiscard]] HWY_INLINE Vector squared() const { return hn::MulAdd(x, x, hn::Mul(y, y)); }
};

HWY_INLINE WayFrom way_from(const NearEdges& edges, float x, float y) {
    const Floats d;
    const Vector to_x = hn::Sub(hn::Set(d, x), edges.start_x);
    const Vector to_y = hn::Sub(hn::Set(d, y), edges.start_y);
    Vector t =
        hn::Mul(hn::MulAdd(to_x, edges.along_x, hn::Mul(to_y, edges.along_y)), edges.inverse);
    t = hn::Min(hn::Max(t, hn::Zero(d)), hn::Set(d, 1.0F));
    return {hn::NegMulAdd(t, edges.along_x, to_x), hn::NegMulAdd(t, edges.along_y, to_y)};
}

/// The edges nearest to the corners and to the centre, each once.
struct Rivals {
    std::array<std::size_t, places> edges{};
    std::size_t count = 0;

    void add(std::size_t edge) {
        if (std::find(edges.begin(), edges.begin() + count, edge) == edges.begin() + count) {
            edges[count++] = edge;
        }
    }
};

/// A place and, per lane, the nearest edge so far.
struct SeenFrom {
    float x;
    float y;
    Vector squared;
    hn::Vec<Words> start_of_vector;

    HWY_INLINE void consider(const NearEdges& some, Mask valid, std::size_t i) {
        const Words words;
        const Vector distance = way_from(some, x, y).squared();
        const Mask nearer = hn::And(valid, hn::Lt(distance, squared));
        squared = hn::IfThenElse(nearer, distance, squared);
        start_of_vector =
            hn::IfThenElse(hn::RebindMask(words, nearer),
                           hn::Set(words, static_cast<std::uint32_t>(i)), start_of_vector);
    }

    [[nodiscard]] HWY_INLINE std::size_t nearest() const {
        const Floats d;
        alignas(64) float distances[16];
        alignas(64) std::uint32_t starts[16];
        hn::Store(squared, d, distances);
        hn::Store(start_of_vector, Words(), starts);
        const float* const best = std::min_element(distances, distances + hn::Lanes(d));
        const std::ptrdiff_t lane = best - distances;
        return starts[lane] + static_cast<std::size_t>(lane);
    }
};

HWY_INLINE SeenFrom seen_from(float x, float y) {
    return {x, y, hn::Set(Floats(), std::numeric_limits<float>::infinity()), hn::Zero(Words())};
}

HWY_INLINE Rivals find_rivals(const EdgeStack& edges, std::size_t first, std::size_t end,
                              const EdgeNode& node) {
    const Floats d;
    const float low_x = node.x - node.half_width;
    const float low_y = node.y - node.half_height;
    const float high_x = node.x + node.half_width;
    const float high_y = node.y + node.half_height;
    SeenFrom centre = seen_from(node.x, node.y);
    SeenFrom low_left = seen_from(low_x, low_y);
    SeenFrom low_right = seen_from(high_x, low_y);
    SeenFrom high_left = seen_from(low_x, high_y);
    SeenFrom high_right = seen_from(high_x, high_y);
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const NearEdges some = load(edges, i);
        const Mask valid = hn::FirstN(d, end - i);
        centre.consider(some, valid, i);
        low_left.consider(some, valid, i);
        low_right.consider(some, valid, i);
        high_left.consider(some, valid, i);
        high_right.consider(some, valid, i);
    }
    Rivals rivals;
    rivals.add(centre.nearest());
    rivals.add(low_left.nearest());
    rivals.add(low_right.nearest());
    rivals.add(high_left.nearest());
    rivals.add(high_right.nearest());
    return rivals;
}

/// Distances from the corners to a rival, plus the slack.
HWY_INLINE void measure(const EdgeStack& edges, std::size_t rival, const EdgeNode& node,
                        float slack, float* bounds) {
    const float along_x = edges.number(EdgeStack::along_x)[rival];
    const float along_y = edges.number(EdgeStack::along_y)[rival];
    const float inverse = edges.number(EdgeStack::inverse)[rival];
    const float to_x = node.x - edges.number(EdgeStack::start_x)[rival];
    const float to_y = node.y - edges.number(EdgeStack::start_y)[rival];
    for (std::size_t corner = 0; corner < corners; ++corner) {
        const float x = to_x + corner_x[corner] * node.half_width;
        const float y = to_y + corner_y[corner] * node.half_height;
        const float t = std::clamp((x * along_x + y * along_y) * inverse, 0.0F, 1.0F);
        const float away_x = x - t * along_x;
        const float away_y = y - t * along_y;
        bounds[corner] = std::sqrt(away_x * away_x + away_y * away_y) + slack;
    }
}

/// The tangents, at a node's centre, of the distances to edges, evaluated at the corners.
struct Tangents {
    Vector at[corners];

    HWY_INLINE Tangents(const WayFrom& way, const EdgeNode& node) {
        const Floats d;
        const Vector distance = hn::Sqrt(way.squared());
        const Vector inverse =
            hn::IfThenElseZero(hn::Gt(distance, hn::Zero(d)), hn::Div(hn::Set(d, 1.0F), distance));
        const Vector slope_x = hn::Mul(hn::Mul(way.x, inverse), hn::Set(d, node.half_width));
        const Vector slope_y = hn::Mul(hn::Mul(way.y, inverse), hn::Set(d, node.half_height));
        const Vector left = hn::Sub(distance, slope_x);
        const Vector right = hn::Add(distance, slope_x);
        at[0] = hn::Sub(left, slope_y);
        at[1] = hn::Sub(right, slope_y);
        at[2] = hn::Add(left, slope_y);
        at[3] = hn::Add(right, slope_y);
    }

    /// The lanes in which an edge may be nearer somewhere than a rival with these bounds.
    [[nodiscard]] HWY_INLINE Mask any_within(const float* bounds) const {
        const Floats d;
        return hn::Or(
            hn::Or(hn::Le(at[0], hn::Set(d, bounds[0])), hn::Le(at[1], hn::Set(d, bounds[1]))),
            hn::Or(hn::Le(at[2], hn::Set(d, bounds[2])), hn::Le(at[3], hn::Set(d, bounds[3]))));
    }
};

void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack) {
    const Floats d;
    const Rivals rivals = find_rivals(edges, first, end, node);
    float bounds[places][corners];
    for (std::size_t i = 0; i < rivals.count; ++i) {
        measure(edges, rivals.edges[i], node, slack, bounds[i]);
    }
    std::size_t pushed = edges.size();
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const NearEdges some = load(edges, i);
        const Tangents tangents(way_from(some, node.x, node.y), node);
        Mask near = hn::FirstN(d, end - i);
        for (std::size_t rival = 0; rival < rivals.count; ++rival) {
            near = hn::And(near, tangents.any_within(bounds[rival]));
        }
        pushed += copy_kept(d, edges, i, near, edges, pushed);
    }
    edges.resize(pushed);
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

HWY_EXPORT(push_near);
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

void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack) {
    edges.reserve(end - first);
    HWY_DYNAMIC_DISPATCH(push_near)(edges, first, end, node, slack);
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
