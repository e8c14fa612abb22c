// Shared by kernels that search around groups of points, per instruction set: each kernel source
// includes this file as often as Highway includes that source.

#include <cmath>
#include <cstdint>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_DISC_OF_POINTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_DISC_OF_POINTS_INL_HPP
#undef NEARFIELD_DISC_OF_POINTS_INL_HPP
#else
#define NEARFIELD_DISC_OF_POINTS_INL_HPP
#endif

#include <engine/simd/box_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// A disc around a group of points.
struct DiscOfPoints {
    double x;
    double y;
    double radius;
};

HWY_INLINE DiscOfPoints disc_around(const Extent& box) {
    const double across = box.high_x - box.low_x;
    const double up = box.high_y - box.low_y;
    return {0.5 * (box.low_x + box.high_x), 0.5 * (box.low_y + box.high_y),
            0.5 * std::sqrt(across * across + up * up)};
}

HWY_INLINE DiscOfPoints disc_around(const PointArrays& points, std::uint32_t first,
                                    std::uint32_t count) {
    return disc_around(extent_of({first + count, points.x, points.y}, first));
}

/// No edge farther than the square root of this from a disc's centre can be nearest to a point of
/// the disc, or as near up to `margin`; slightly increased for rounding. `least`: squared distance
/// of the edge nearest to the centre.
HWY_INLINE double squared_reach(const DiscOfPoints& disc, double least, double margin) {
    const double reach = std::sqrt(least) + 2.0 * disc.radius + margin;
    return beyond_rounding(reach);
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
