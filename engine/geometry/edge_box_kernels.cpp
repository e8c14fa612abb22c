#include <engine/geometry/edge_boxes.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/geometry/edge_box_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint32_t fan_out = EdgeBoxes::fan_out;
using Tag = hn::CappedTag<double, fan_out>;
using Lanes = hn::Vec<Tag>;

/// The largest of one coordinate of a polygon's transformed vertices, or of its opposite.
class Farthest {
public:
    HWY_INLINE Farthest(const TransformedPolygon& placed, const EdgeBoxes& boxes, int axis,
                        double sign)
        : vertices_(placed.polygon().vertices().data()->data()),
          count_(placed.polygon().size()),
          boxes_(boxes),
          x_(placed.rotation()(axis, 0)),
          y_(placed.rotation()(axis, 1)),
          translation_(placed.translation()[axis]),
          sign_(sign),
          to_box_(sign * translation_ + box_allowance(placed)) {}

    HWY_INLINE double Find() {
        Visit(boxes_.top_level(), 0);
        return farthest_;
    }

private:
    void Visit(std::uint32_t level, std::uint32_t number) {
        const Tag tag;
        const EdgeBoxes::Group& group = boxes_.group(level, number);
        const Lanes to_x = hn::Set(tag, sign_ * x_);
        const Lanes to_y = hn::Set(tag, sign_ * y_);
        HWY_ALIGN double reach[fan_out];
        for (std::uint32_t i = 0; i < fan_out; i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
            const Lanes along_x = hn::Load(tag, group.along_x + i);
            const Lanes along_y = hn::Load(tag, group.along_y + i);
            const Lanes centre = hn::Add(hn::Mul(to_x, hn::Load(tag, group.x + i)),
                                         hn::Mul(to_y, hn::Load(tag, group.y + i)));
            const Lanes along = hn::Abs(hn::Add(hn::Mul(to_x, along_x), hn::Mul(to_y, along_y)));
            const Lanes across = hn::Abs(hn::Sub(hn::Mul(to_y, along_x), hn::Mul(to_x, along_y)));
            const Lanes half = hn::Add(hn::Mul(along, hn::Load(tag, group.half_along + i)),
                                       hn::Mul(across, hn::Load(tag, group.half_across + i)));
            hn::Store(hn::Add(hn::Add(centre, half), hn::Set(tag, to_box_)), tag, reach + i);
        }
        for (;;) {
            const double* const next = std::max_element(reach, reach + fan_out);
            if (!(*next > farthest_)) {
                return;
            }
            const auto i = static_cast<std::uint32_t>(next - reach);
            reach[i] = -std::numeric_limits<double>::infinity();
            if (level == 0) {
                Look(fan_out * (fan_out * number + i));
            } else {
                Visit(level - 1, fan_out * number + i);
            }
        }
    }

    HWY_INLINE void Look(std::uint32_t first) {
        const std::uint32_t end = std::min(first + fan_out, count_);
        for (std::uint32_t i = first; i < end; ++i) {
            // As place_points().
            const double placed =
                (x_ * vertices_[2 * i] + y_ * vertices_[2 * i + 1]) + translation_;
            farthest_ = std::max(farthest_, sign_ * placed);
        }
    }

    const double* vertices_;
    std::uint32_t count_;
    const EdgeBoxes& boxes_;
    double x_;
    double y_;
    double translation_;
    double sign_;
    double to_box_;  // from the sum of a box's centre and half, turned, to its farther side
    double farthest_ = -std::numeric_limits<double>::infinity();
};

void FindBox(const TransformedPolygon& placed, const EdgeBoxes& boxes, Box& box) {
    for (const int axis : {0, 1}) {
        box.min()[axis] = -Farthest(placed, boxes, axis, -1.0).Find();
        box.max()[axis] = Farthest(placed, boxes, axis, 1.0).Find();
    }
}

/// Nine vertices, by how far they are along and across the way from the first to the last.
HWY_INLINE void bound_run(const double* interleaved, EdgeBoxes::Group& group, std::uint32_t i) {
    const Tag tag;
    const double* const last = interleaved + 2 * fan_out;
    const double x = last[0] - interleaved[0];
    const double y = last[1] - interleaved[1];
    const double length = std::sqrt(x * x + y * y);
    const double along_x = length > 0.0 ? x / length : 1.0;
    const double along_y = length > 0.0 ? y / length : 0.0;
    // The last one in every lane.
    Lanes low_along = hn::Set(tag, along_x * last[0] + along_y * last[1]);
    Lanes low_across = hn::Set(tag, along_x * last[1] - along_y * last[0]);
    Lanes high_along = low_along;
    Lanes high_across = low_across;
    for (std::size_t k = 0; k < fan_out; k += hn::Lanes(tag)) {
        Lanes of_x;
        Lanes of_y;
        hn::LoadInterleaved2(tag, interleaved + 2 * k, of_x, of_y);
        const Lanes along =
            hn::Add(hn::Mul(hn::Set(tag, along_x), of_x), hn::Mul(hn::Set(tag, along_y), of_y));
        const Lanes across =
            hn::Sub(hn::Mul(hn::Set(tag, along_x), of_y), hn::Mul(hn::Set(tag, along_y), of_x));
        low_along = hn::Min(low_along, along);
        high_along = hn::Max(high_along, along);
        low_across = hn::Min(low_across, across);
        high_across = hn::Max(high_across, across);
    }
    const double unit[] = {along_x, along_y};
    group.set(i, unit, hn::GetLane(hn::MinOfLanes(tag, low_along)),
              hn::GetLane(hn::MaxOfLanes(tag, high_along)),
              hn::GetLane(hn::MinOfLanes(tag, low_across)),
              hn::GetLane(hn::MaxOfLanes(tag, high_across)));
}

void BoundRuns(const double* interleaved, std::uint32_t first, std::uint32_t end,
               EdgeBoxes::Group* groups) {
    for (std::uint32_t run = first; run < end; ++run) {
        bound_run(interleaved + std::size_t{2} * fan_out * run, groups[run / fan_out],
                  run % fan_out);
    }
}

}  // namespace nearfield::geometry::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::geometry::kernels {

HWY_EXPORT(FindBox);
HWY_EXPORT(BoundRuns);

void bound_runs(const Vector* vertices, std::uint32_t first, std::uint32_t end,
                EdgeBoxes::Group* groups) {
    HWY_DYNAMIC_DISPATCH(BoundRuns)(vertices->data(), first, end, groups);
}

Box find_box(const TransformedPolygon& placed, const EdgeBoxes& boxes) {
    Box box;
    HWY_DYNAMIC_DISPATCH(FindBox)(placed, boxes, box);
    return box;
}

}  // namespace nearfield::geometry::kernels
#endif
