// Shared by the kernels over oriented boxes, per instruction set: each kernel source includes this
// file as often as Highway includes that source.

#include <engine/simd/edges_on_demand.hpp>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_ORIENTED_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_ORIENTED_LANES_INL_HPP
#undef NEARFIELD_ORIENTED_LANES_INL_HPP
#else
#define NEARFIELD_ORIENTED_LANES_INL_HPP
#endif

#include <engine/simd/lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// Oriented boxes as they lie, as in EdgeBoxes::Group.
struct OrientedLanes {
    Lanes x;
    Lanes y;
    Lanes along_x;
    Lanes along_y;
    Lanes half_along;
    Lanes half_across;
};

/// The boxes i, i + 1, ... of a group, placed.
HWY_INLINE OrientedLanes oriented_at(const geometry::EdgeBoxes::Group& group, std::size_t i,
                                     const geometry::Placement& placement) {
    const Tag tag;
    const auto turned = [&](std::size_t axis, Lanes x, Lanes y) HWY_ATTR {
        return hn::Add(hn::Mul(hn::Set(tag, placement.x_axis[axis]), x),
                       hn::Mul(hn::Set(tag, placement.y_axis[axis]), y));
    };
    const Lanes x = hn::LoadU(tag, group.x + i);
    const Lanes y = hn::LoadU(tag, group.y + i);
    const Lanes along_x = hn::LoadU(tag, group.along_x + i);
    const Lanes along_y = hn::LoadU(tag, group.along_y + i);
    return {hn::Add(turned(0, x, y), hn::Set(tag, placement.translation[0])),
            hn::Add(turned(1, x, y), hn::Set(tag, placement.translation[1])),
            turned(0, along_x, along_y),
            turned(1, along_x, along_y),
            hn::LoadU(tag, group.half_along + i),
            hn::LoadU(tag, group.half_across + i)};
}

/// A point as a polygon's boxes see it.
struct LocalPoint {
    Lanes x;
    Lanes y;

    HWY_INLINE LocalPoint(const geometry::Placement& placement, double of_x, double of_y) {
        const double off_x = of_x - placement.translation[0];
        const double off_y = of_y - placement.translation[1];
        x = hn::Set(Tag(), placement.x_axis[0] * off_x + placement.x_axis[1] * off_y);
        y = hn::Set(Tag(), placement.y_axis[0] * off_x + placement.y_axis[1] * off_y);
    }
};

/// Squared distances of the boxes i, i + 1, ... of a group, enlarged by an allowance, from a point.
HWY_INLINE Lanes squared_from(const geometry::EdgeBoxes::Group& group, std::size_t i,
                              const LocalPoint& point, Lanes allowance) {
    const Tag tag;
    const Lanes off_x = hn::Sub(point.x, hn::LoadU(tag, group.x + i));
    const Lanes off_y = hn::Sub(point.y, hn::LoadU(tag, group.y + i));
    const Lanes along_x = hn::LoadU(tag, group.along_x + i);
    const Lanes along_y = hn::LoadU(tag, group.along_y + i);
    const auto beyond = [&](Lanes off, const double* half) HWY_ATTR {
        const Lanes reach = hn::Add(hn::LoadU(tag, half + i), allowance);
        return hn::Max(hn::Sub(hn::Abs(off), reach), hn::Zero(tag));
    };
    const Lanes along =
        beyond(hn::Add(hn::Mul(along_x, off_x), hn::Mul(along_y, off_y)), group.half_along);
    const Lanes across = beyond(cross_lanes(along_x, along_y, off_x, off_y), group.half_across);
    return hn::Add(hn::Mul(along, along), hn::Mul(across, across));
}

/// How far boxes are apart across the first ones, at least.
HWY_INLINE Lanes gap_across(const OrientedLanes& boxes, const OrientedLanes& others, Lanes off_x,
                            Lanes off_y) {
    const Lanes along = hn::Abs(
        hn::Add(hn::Mul(boxes.along_x, others.along_x), hn::Mul(boxes.along_y, others.along_y)));
    const Lanes across =
        hn::Abs(cross_lanes(boxes.along_x, boxes.along_y, others.along_x, others.along_y));
    const Lanes reach =
        hn::Add(hn::Mul(across, others.half_along), hn::Mul(along, others.half_across));
    return hn::Sub(hn::Sub(hn::Abs(cross_lanes(boxes.along_x, boxes.along_y, off_x, off_y)),
                           boxes.half_across),
                   reach);
}

/// How far boxes are apart across either, at least; negative if that does not tell.
HWY_INLINE Lanes gaps_between(const OrientedLanes& boxes, const OrientedLanes& others) {
    const Lanes off_x = hn::Sub(boxes.x, others.x);
    const Lanes off_y = hn::Sub(boxes.y, others.y);
    return hn::Max(gap_across(boxes, others, off_x, off_y),
                   gap_across(others, boxes, off_x, off_y));
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
