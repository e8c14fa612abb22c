#include <engine/geometry/vertex_kernels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/geometry/vertex_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t max_lanes = 8;
using Tag = hn::CappedTag<double, max_lanes>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE double min_lane(Lanes lanes) {
    return hn::GetLane(hn::MinOfLanes(Tag(), lanes));
}

HWY_INLINE double max_lane(Lanes lanes) {
    return hn::GetLane(hn::MaxOfLanes(Tag(), lanes));
}

struct TransformedPoints {
    Lanes x;
    Lanes y;
};

HWY_INLINE TransformedPoints place_lanes(const double* interleaved, const Placement& placement) {
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

/// Transforms points a vector at a time and calls `use(i, placed)` with those from point i on; the
/// last lanes may repeat earlier points. Returns their bounding box.
template <class Use>
HWY_INLINE Extent place_all(const double* interleaved, std::size_t count,
                            const Placement& placement, const Use& use) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    double padded_points[2 * max_lanes];
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
    for (std::size_t i = 0; i < count; i += lanes) {
        const std::size_t from = i + lanes <= count || i == 0 ? i : count - lanes;
        const TransformedPoints placed = place_lanes(interleaved + 2 * from, placement);
        low_x = hn::Min(low_x, placed.x);
        low_y = hn::Min(low_y, placed.y);
        high_x = hn::Max(high_x, placed.x);
        high_y = hn::Max(high_y, placed.y);
        use(from, placed);
    }
    return {min_lane(low_x), min_lane(low_y), max_lane(high_x), max_lane(high_y)};
}

Extent PlacePoints(const double* interleaved, std::size_t count, const Placement& placement,
                   double* x, double* y) {
    const Tag tag;
    if (count < hn::Lanes(tag)) {
        return place_all(interleaved, count, placement,
                         [&](std::size_t, const TransformedPoints& placed) HWY_ATTR {
                             double transformed_x[max_lanes];
                             double transformed_y[max_lanes];
                             hn::StoreU(placed.x, tag, transformed_x);
                             hn::StoreU(placed.y, tag, transformed_y);
                             std::memcpy(x, transformed_x, count * sizeof(double));
                             std::memcpy(y, transformed_y, count * sizeof(double));
                         });
    }
    return place_all(interleaved, count, placement,
                     [&](std::size_t i, const TransformedPoints& placed) HWY_ATTR {
                         hn::StoreU(placed.x, tag, x + i);
                         hn::StoreU(placed.y, tag, y + i);
                     });
}

Extent FindExtent(const double* interleaved, std::size_t count, const Placement& placement) {
    return place_all(interleaved, count, placement, [](std::size_t, const TransformedPoints&) {});
}

/// A range that grows vertex by vertex.
struct GrowingRange {
    Extent box{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double sum = 0.0;  // NaN if any coordinate is not finite
    // In parts, coordinate by coordinate, so that the number of lanes does not determine the
    // rounding of their sum.
    std::array<double, max_lanes> length{};

    /// `i`: the vertex.
    HWY_INLINE void add(std::size_t i, const double* vertex, const double* next) {
        box.low_x = std::min(box.low_x, vertex[0]);
        box.low_y = std::min(box.low_y, vertex[1]);
        box.high_x = std::max(box.high_x, vertex[0]);
        box.high_y = std::max(box.high_y, vertex[1]);
        sum += vertex[0] * 0.0 + vertex[1] * 0.0;
        length[2 * i % max_lanes] += std::abs(next[0] - vertex[0]);
        length[(2 * i + 1) % max_lanes] += std::abs(next[1] - vertex[1]);
    }
};

VertexRange FindRange(const double* interleaved, std::size_t count) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    GrowingRange range;
    std::size_t i = 0;
    constexpr std::size_t step = max_lanes / 2;
    if (lanes > 1 && count > step) {
        // x and y alternate, as in memory. Zero times an infinite coordinate is NaN.
        const Lanes zero = hn::Zero(tag);
        Lanes low = hn::Set(tag, std::numeric_limits<double>::infinity());
        Lanes high = hn::Neg(low);
        Lanes sum = zero;
        for (; i + step < count; i += step) {
            for (std::size_t lane = 0; lane < max_lanes; lane += lanes) {
                const double* const first = interleaved + 2 * i + lane;
                const Lanes vertices = hn::LoadU(tag, first);
                const Lanes along = hn::Abs(hn::Sub(hn::LoadU(tag, first + 2), vertices));
                low = hn::Min(low, vertices);
                high = hn::Max(high, vertices);
                sum = hn::Add(sum, hn::Mul(vertices, zero));
                double* const length = range.length.data() + lane;
                hn::StoreU(hn::Add(hn::LoadU(tag, length), along), tag, length);
            }
        }
        double lows[max_lanes];
        double highs[max_lanes];
        hn::StoreU(low, tag, lows);
        hn::StoreU(high, tag, highs);
        for (std::size_t lane = 0; lane < lanes; lane += 2) {
            range.box = {std::min(range.box.low_x, lows[lane]),
                         std::min(range.box.low_y, lows[lane + 1]),
                         std::max(range.box.high_x, highs[lane]),
                         std::max(range.box.high_y, highs[lane + 1])};
        }
        range.sum = hn::GetLane(hn::SumOfLanes(tag, sum));
    }
    for (; i < count; ++i) {
        range.add(i, interleaved + 2 * i, interleaved + 2 * (i + 1 < count ? i + 1 : 0));
    }
    return {range.box, range.sum == 0.0,
            std::accumulate(range.length.begin(), range.length.end(), 0.0)};
}

void Subtract(const double* interleaved, std::size_t count, double x, double y, double* relative) {
    const Tag tag;
    const std::size_t step = hn::Lanes(tag) / 2;
    std::size_t i = 0;
    if (step > 0) {
        const Lanes centre = hn::OddEven(hn::Set(tag, y), hn::Set(tag, x));
        for (; i + step <= count; i += step) {
            hn::StoreU(hn::Sub(hn::LoadU(tag, interleaved + 2 * i), centre), tag, relative + 2 * i);
        }
    }
    for (; i < count; ++i) {
        relative[2 * i] = interleaved[2 * i] - x;
        relative[2 * i + 1] = interleaved[2 * i + 1] - y;
    }
}

}  // namespace nearfield::geometry::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::geometry::kernels {

HWY_EXPORT(PlacePoints);
HWY_EXPORT(FindExtent);
HWY_EXPORT(FindRange);
HWY_EXPORT(Subtract);

namespace {

// x and y alternate in arrays of either type.
static_assert(sizeof(Vector2) == 2 * sizeof(double) && sizeof(Vector) == 2 * sizeof(double));

const double* interleaved(std::span<const Vector2> vertices) {
    return &vertices.front().x;
}
const double* interleaved(std::span<const Vector> vertices) {
    return vertices.front().data();
}

}  // namespace

Extent place_points(std::span<const Vector> vertices, const Placement& placement, double* x,
                    double* y) {
    return HWY_DYNAMIC_DISPATCH(PlacePoints)(interleaved(vertices), vertices.size(), placement, x,
                                             y);
}

Extent find_extent(std::span<const Vector> vertices, const Placement& placement) {
    return HWY_DYNAMIC_DISPATCH(FindExtent)(interleaved(vertices), vertices.size(), placement);
}

VertexRange find_range(std::span<const Vector2> vertices) {
    return HWY_DYNAMIC_DISPATCH(FindRange)(interleaved(vertices), vertices.size());
}

void subtract(std::span<const Vector2> vertices, const Vector& centre, Vector* relative) {
    HWY_DYNAMIC_DISPATCH(Subtract)
    (interleaved(vertices), vertices.size(), centre.x(), centre.y(), relative->data());
}

}  // namespace nearfield::geometry::kernels
#endif
