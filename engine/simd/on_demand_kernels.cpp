#include <engine/simd/edges_on_demand.hpp>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/on_demand_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/oriented_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

constexpr std::size_t run_length = geometry::EdgeBoxes::fan_out;

void PlaceBoxes(const geometry::EdgeBoxes::Group& group, const geometry::Placement& placement,
                double allowance, double* low_x, std::size_t stride) {
    const Tag tag;
    for (std::size_t i = 0; i < run_length; i += hn::Lanes(tag)) {
        const OrientedLanes box = oriented_at(group, i, placement);
        const Lanes along_x = hn::Abs(box.along_x);
        const Lanes along_y = hn::Abs(box.along_y);
        const Lanes more = hn::Set(tag, allowance);
        const Lanes half_x = hn::Add(
            hn::Add(hn::Mul(along_x, box.half_along), hn::Mul(along_y, box.half_across)), more);
        const Lanes half_y = hn::Add(
            hn::Add(hn::Mul(along_y, box.half_along), hn::Mul(along_x, box.half_across)), more);
        hn::StoreU(hn::Sub(box.x, half_x), tag, low_x + i);
        hn::StoreU(hn::Sub(box.y, half_y), tag, low_x + stride + i);
        hn::StoreU(hn::Add(box.x, half_x), tag, low_x + 2 * stride + i);
        hn::StoreU(hn::Add(box.y, half_y), tag, low_x + 3 * stride + i);
    }
}

void PlaceEdges(const double* interleaved, const geometry::Placement& placement, double* start_x,
                std::size_t stride) {
    const Tag tag;
    const auto place = [&](std::size_t vertex, double* to) HWY_ATTR {
        Lanes x;
        Lanes y;
        hn::LoadInterleaved2(tag, interleaved + 2 * vertex, x, y);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Lanes turned = hn::Add(hn::Mul(hn::Set(tag, placement.x_axis[axis]), x),
                                         hn::Mul(hn::Set(tag, placement.y_axis[axis]), y));
            hn::StoreU(hn::Add(turned, hn::Set(tag, placement.translation[axis])), tag,
                       to + axis * stride);
        }
    };
    for (std::size_t i = 0; i < run_length; i += hn::Lanes(tag)) {
        place(i, start_x + i);
        place(i + 1, start_x + 2 * stride + i);
    }
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(PlaceBoxes);
HWY_EXPORT(PlaceEdges);

void place_boxes(const geometry::EdgeBoxes::Group& group, const geometry::Placement& placement,
                 double allowance, double* low_x, std::size_t stride) {
    HWY_DYNAMIC_DISPATCH(PlaceBoxes)(group, placement, allowance, low_x, stride);
}

void place_edges(const geometry::Vector* vertices, const geometry::Placement& placement,
                 double* start_x, std::size_t stride) {
    HWY_DYNAMIC_DISPATCH(PlaceEdges)(vertices->data(), placement, start_x, stride);
}

}  // namespace nearfield::simd::kernels
#endif
