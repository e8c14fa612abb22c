#include <engine/plan/edge_stack.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/plan/edge_stack.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::plan::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

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

/// From the point of an edge that is nearest to a place, to that place.
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
    std::array<std::size_t, places> edges;
    std::size_t count = 0;

    void add(std::size_t edge) {
        if (std::find(edges.begin(), edges.begin() + count, edge) == edges.begin() + count) {
            edges[count++] = edge;
        }
    }
};

HWY_INLINE Rivals find_rivals(const EdgeStack& edges, std::size_t first, std::size_t end,
                              const EdgeNode& node) {
    const Floats d;
    const Words words;
    const Vector infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    float x[places];
    float y[places];
    alignas(64) float least[places][16];
    alignas(64) std::uint32_t nearest[places][16];
    for (std::size_t place = 0; place < places; ++place) {
        x[place] = node.x + (place < corners ? corner_x[place] * node.half_width : 0.0F);
        y[place] = node.y + (place < corners ? corner_y[place] * node.half_height : 0.0F);
    }
    Vector least0 = infinity, least1 = infinity, least2 = infinity, least3 = infinity,
           least4 = infinity;
    auto nearest0 = hn::Zero(words);
    auto nearest1 = nearest0, nearest2 = nearest0, nearest3 = nearest0, nearest4 = nearest0;
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const NearEdges some = load(edges, i);
        const Mask valid = hn::FirstN(d, end - i);
        const auto here = hn::Set(words, static_cast<std::uint32_t>(i));
        const auto consider = [&](std::size_t place, Vector& so_far, auto& where) HWY_ATTR {
            const Vector squared = way_from(some, x[place], y[place]).squared();
            const Mask nearer = hn::And(valid, hn::Lt(squared, so_far));
            so_far = hn::IfThenElse(nearer, squared, so_far);
            where = hn::IfThenElse(hn::RebindMask(words, nearer), here, where);
        };
        consider(0, least0, nearest0);
        consider(1, least1, nearest1);
        consider(2, least2, nearest2);
        consider(3, least3, nearest3);
        consider(4, least4, nearest4);
    }
    const auto store = [&](std::size_t place, Vector distance, auto where) HWY_ATTR {
        hn::Store(distance, d, least[place]);
        hn::Store(where, words, nearest[place]);
    };
    store(0, least0, nearest0);
    store(1, least1, nearest1);
    store(2, least2, nearest2);
    store(3, least3, nearest3);
    store(4, least4, nearest4);
    Rivals rivals;
    for (std::size_t place = 0; place < places; ++place) {
        std::size_t best = 0;
        for (std::size_t lane = 1; lane < hn::Lanes(d); ++lane) {
            best = least[place][lane] < least[place][best] ? lane : best;
        }
        rivals.add(nearest[place][best] + best);
    }
    return rivals;
}

void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack) {
    const Floats d;
    const Words words;
    const Rivals rivals = find_rivals(edges, first, end, node);
    // From the corners to each rival, and the slack more.
    float bounds[places][corners];
    for (std::size_t rival = 0; rival < rivals.count; ++rival) {
        const std::size_t i = rivals.edges[rival];
        const float along_x = edges.number(EdgeStack::along_x)[i];
        const float along_y = edges.number(EdgeStack::along_y)[i];
        for (std::size_t corner = 0; corner < corners; ++corner) {
            const float x =
                node.x + corner_x[corner] * node.half_width - edges.number(EdgeStack::start_x)[i];
            const float y =
                node.y + corner_y[corner] * node.half_height - edges.number(EdgeStack::start_y)[i];
            const float t = std::min(
                std::max((x * along_x + y * along_y) * edges.number(EdgeStack::inverse)[i], 0.0F),
                1.0F);
            const float away_x = x - t * along_x;
            const float away_y = y - t * along_y;
            bounds[rival][corner] = std::sqrt(away_x * away_x + away_y * away_y) + slack;
        }
    }
    std::size_t pushed = edges.size();
    for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
        const NearEdges some = load(edges, i);
        const WayFrom way = way_from(some, node.x, node.y);
        const Vector distance = hn::Sqrt(way.squared());
        const Vector inverse =
            hn::IfThenElseZero(hn::Gt(distance, hn::Zero(d)), hn::Div(hn::Set(d, 1.0F), distance));
        const Vector slope_x = hn::Mul(hn::Mul(way.x, inverse), hn::Set(d, node.half_width));
        const Vector slope_y = hn::Mul(hn::Mul(way.y, inverse), hn::Set(d, node.half_height));
        const Vector left = hn::Sub(distance, slope_x);
        const Vector right = hn::Add(distance, slope_x);
        const Vector tangents[corners] = {hn::Sub(left, slope_y), hn::Sub(right, slope_y),
                                          hn::Add(left, slope_y), hn::Add(right, slope_y)};
        Mask near = hn::FirstN(d, end - i);
        for (std::size_t rival = 0; rival < rivals.count; ++rival) {
            const float* bound = bounds[rival];
            near = hn::And(near, hn::Or(hn::Or(hn::Le(tangents[0], hn::Set(d, bound[0])),
                                               hn::Le(tangents[1], hn::Set(d, bound[1]))),
                                        hn::Or(hn::Le(tangents[2], hn::Set(d, bound[2])),
                                               hn::Le(tangents[3], hn::Set(d, bound[3])))));
        }
        if (hn::AllFalse(d, near)) {
            continue;
        }
        hn::CompressStore(some.start_x, near, d, edges.number(EdgeStack::start_x) + pushed);
        hn::CompressStore(some.start_y, near, d, edges.number(EdgeStack::start_y) + pushed);
        hn::CompressStore(some.along_x, near, d, edges.number(EdgeStack::along_x) + pushed);
        hn::CompressStore(some.along_y, near, d, edges.number(EdgeStack::along_y) + pushed);
        hn::CompressStore(some.inverse, near, d, edges.number(EdgeStack::inverse) + pushed);
        pushed += hn::CompressStore(hn::LoadU(words, edges.indices() + i),
                                    hn::RebindMask(words, near), words, edges.indices() + pushed);
    }
    edges.shrink(pushed);
}

}  // namespace
}  // namespace nearfield::plan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::plan {

HWY_EXPORT(push_near);

void EdgeStack::push(const std::array<float, numbers>& edge, std::uint32_t index) {
    reserve(1);
    for (std::size_t i = 0; i < numbers; ++i) {
        numbers_[i][count_] = edge[i];
    }
    indices_[count_] = index;
    ++count_;
}

void EdgeStack::append(const EdgeStack& other, std::size_t first, std::size_t end) {
    const std::size_t count = end - first;
    reserve(count);
    for (std::size_t i = 0; i < numbers; ++i) {
        std::memcpy(number(i) + count_, other.number(i) + first, count * sizeof(float));
    }
    std::memcpy(indices() + count_, other.indices() + first, count * sizeof(std::uint32_t));
    count_ += count;
}

void EdgeStack::reserve(std::size_t more) {
    constexpr std::size_t longest_vector = 16;
    const std::size_t wanted = count_ + more + longest_vector;
    if (wanted > indices_.size()) {
        const std::size_t capacity = wanted + wanted / 2;
        for (std::vector<float>& number : numbers_) {
            number.resize(capacity);
        }
        indices_.resize(capacity);
    }
}

void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack) {
    edges.reserve(end - first);
    HWY_DYNAMIC_DISPATCH(push_near)(edges, first, end, node, slack);
}

}  // namespace nearfield::plan
#endif
