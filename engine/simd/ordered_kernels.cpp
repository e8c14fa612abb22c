#include <engine/simd/ordered_search.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/ordered_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/near_few-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// A path with what the test against boxes needs.
struct PathLanes {
    Lanes from_x;
    Lanes from_y;
    Lanes inverse_x;
    Lanes inverse_y;

    HWY_INLINE PathLanes(const Path& path, const PathInverse& inverse)
        : from_x(hn::Set(Tag(), path.from_x)),
          from_y(hn::Set(Tag(), path.from_y)),
          inverse_x(hn::Set(Tag(), inverse.x)),
          inverse_y(hn::Set(Tag(), inverse.y)) {}
};

/// The parameters, from 0 to 1, at which a path enters boxes grown by a margin; infinity if it does
/// not.
HWY_INLINE Lanes entries(const LanesOfExtent& boxes, const PathLanes& path, Lanes margin) {
    const Tag tag;
    const Lanes low_x = hn::Mul(hn::Sub(hn::Sub(boxes.low_x, margin), path.from_x), path.inverse_x);
    const Lanes high_x =
        hn::Mul(hn::Sub(hn::Add(boxes.high_x, margin), path.from_x), path.inverse_x);
    const Lanes low_y = hn::Mul(hn::Sub(hn::Sub(boxes.low_y, margin), path.from_y), path.inverse_y);
    const Lanes high_y =
        hn::Mul(hn::Sub(hn::Add(boxes.high_y, margin), path.from_y), path.inverse_y);
    const Lanes begin =
        hn::Max(hn::Max(hn::Min(low_x, high_x), hn::Min(low_y, high_y)), hn::Zero(tag));
    const Lanes end =
        hn::Min(hn::Min(hn::Max(low_x, high_x), hn::Max(low_y, high_y)), hn::Set(tag, 1.0));
    // Boxes that hold nothing reach from infinity to minus infinity, which a path would enter.
    const LaneMask enters = hn::And(hn::Le(begin, end), hn::Le(boxes.low_x, boxes.high_x));
    return hn::IfThenElse(enters, begin, hn::Set(tag, std::numeric_limits<double>::infinity()));
}

/// Searches a tree, box by box in ascending order of a key. `Aim` measures and handles:
///   Lanes Keys(boxes)               the keys of boxes; infinity excludes one
///   double bound()                  boxes with a larger key are not entered
///   void Use(box)                   a lowest box
template <class Aim>
class OrderedSearch {
public:
    HWY_INLINE OrderedSearch(const AabbTree& tree, Aim& aim) : tree_(tree), aim_(aim) {}

    void Run() { Visit(tree_.top_level(), 0); }

private:
    void Visit(std::uint32_t level, std::uint32_t first) {
        const Tag tag;
        const BoxArrays& boxes = tree_.boxes(level, first);
        double keys[fan_out];
        // Boxes that hold nothing have an infinite key, and a bound may be infinite.
        const Lanes most = hn::Set(tag, std::min(aim_.bound(), std::numeric_limits<double>::max()));
        std::uint32_t left = 0;
        Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes own = aim_.Keys(boxes_at(boxes, first + i));
            hn::StoreU(own, tag, keys + i);
            left |= bits_of(hn::Le(own, most)) << i;
            least = hn::Min(least, own);
        }
        if (left == 0) {
            return;
        }
        std::uint32_t nearest = first_of(left);
        if ((left & (left - 1)) != 0) {
            // The nearest without branches: which box it is cannot be predicted.
            const Lanes nearest_key = hn::Set(tag, min_lane(least));
            nearest = first_of(bits_of_eight([&](std::size_t i) HWY_ATTR {
                return hn::Eq(hn::LoadU(tag, keys + i), nearest_key);
            }));
        }
        for (;;) {
            Enter(level, first + nearest);
            left &= ~(1U << nearest);
            if (left == 0) {
                return;
            }
            nearest = first_of(left);
            for (std::uint32_t others = left & (left - 1); others != 0; others &= others - 1) {
                const std::uint32_t other = first_of(others);
                nearest = keys[other] < keys[nearest] ? other : nearest;
            }
            if (keys[nearest] > aim_.bound()) {
                return;
            }
        }
    }

    HWY_INLINE void Enter(std::uint32_t level, std::uint32_t box) {
        if (level > 0) {
            Visit(level - 1, fan_out * box);
        } else {
            aim_.Use(box);
        }
    }

    static HWY_INLINE std::uint32_t first_of(std::uint32_t bits) {
        return static_cast<std::uint32_t>(std::countr_zero(bits));
    }

    const AabbTree& tree_;
    Aim& aim_;
};

/// The edges near a point.
class NearPoint {
public:
    HWY_INLINE NearPoint(const AabbTree& tree, double x, double y, double bound,
                         const BoundedEdgeSink& sink)
        : tree_(tree), point_(lanes_of({x, y, x, y})), sink_(sink), bound_(bound) {}

    [[nodiscard]] HWY_INLINE Lanes Keys(const LanesOfExtent& boxes) const {
        return squared_between(boxes, point_);
    }
    [[nodiscard]] HWY_INLINE double bound() const { return bound_; }
    HWY_INLINE void Use(std::uint32_t box) {
        const Tag tag;
        const EdgeRange range = tree_.edges_of(box);
        std::uint32_t found = bits_of_eight([&](std::size_t i) HWY_ATTR {
            return hn::Le(squared_distances(edges_along(tree_.edges(), range.first + i),
                                            point_.low_x, point_.low_y),
                          hn::Set(tag, bound_));
        });
        for (found &= bits_of_range(range); found != 0; found &= found - 1) {
            bound_ = sink_(range.first + static_cast<std::uint32_t>(std::countr_zero(found)));
        }
    }

private:
    const AabbTree& tree_;
    LanesOfExtent point_;
    const BoundedEdgeSink& sink_;
    double bound_;
};

void ForEdgesNear(const AabbTree& tree, double x, double y, double bound,
                  const BoundedEdgeSink& sink) {
    NearPoint aim(tree, x, y, bound, sink);
    OrderedSearch<NearPoint>(tree, aim).Run();
}

double ForClosestToFew(const FewEdges& few, const AabbTree& tree, double most, double margin,
                       const NearPairSink& sink) {
    NearFew aim(few, tree, most, margin, sink);
    OrderedSearch<NearFew>(tree, aim).Run();
    return aim.least();
}

void MeasureBoxes(const BoxArrays& boxes, std::uint32_t first, const Extent& from,
                  BoxKeys& squared) {
    const LanesOfExtent other = lanes_of(from);
    for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
        hn::StoreU(squared_between(boxes_at(boxes, first + i), other), Tag(), squared.data() + i);
    }
}

/// `groups`: a constant where there is one, which needs no loop.
template <class Count>
HWY_INLINE void enter_boxes(PathStep& step, Count groups) {
    const Tag tag;
    const PathLanes path(step.path, step.inverse);
    // Twice the margin, because the values that boxes are compared by are rounded too.
    const Lanes margin = hn::Set(tag, 2.0 * step.margin);
    const Lanes bound = hn::Set(tag, step.bound);
    Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
    std::uint32_t met = 0;
    for (std::uint32_t group = 0; group < groups; ++group) {
        const double* const low_x = step.low_x + std::size_t{group} * step.group_stride;
        const BoxArrays boxes{fan_out, low_x, low_x + step.stride, low_x + 2 * step.stride,
                              low_x + 3 * step.stride};
        double* const own = step.keys + group * fan_out;
        met |= bits_of_eight([&](std::size_t i) HWY_ATTR {
                   const Lanes keys = entries(boxes_at(boxes, i), path, margin);
                   hn::StoreU(keys, tag, own + i);
                   least = hn::Min(least, keys);
                   return hn::Le(keys, bound);
               })
               << (group * fan_out);
    }
    const Lanes nearest = hn::Set(tag, min_lane(least));
    std::uint32_t nearest_ones = 0;
    for (std::uint32_t group = 0; group < groups; ++group) {
        const std::uint32_t equal = bits_of_eight([&](std::size_t i) HWY_ATTR {
            return hn::Eq(hn::LoadU(tag, step.keys + group * fan_out + i), nearest);
        });
        nearest_ones |= equal << (group * fan_out);
    }
    step.met = met;
    step.nearest = static_cast<std::uint32_t>(std::countr_zero(nearest_ones));
}

HWY_INLINE void meet_edges(PathStep& step) {
    const EdgeArrays path{
        1, &step.path.from_x, &step.path.from_y, &step.path.to_x, &step.path.to_y, nullptr};
    step.met =
        bits_of_range(step.range) & bits_of_eight([&](std::size_t i) HWY_ATTR {
            return may_meet(path, 0, EdgeLanes(*step.edges, step.range.first + i), step.margin);
        });
}

void TakeSteps(std::span<PathStep> steps, const PathLists& paths) {
    for (const std::uint32_t path : paths.of(PathLists::one_group)) {
        enter_boxes(steps[path], std::integral_constant<std::uint32_t, 1>());
    }
    for (const std::uint32_t path : paths.of(PathLists::groups)) {
        enter_boxes(steps[path], steps[path].groups);
    }
    for (const std::uint32_t path : paths.of(PathLists::edges)) {
        meet_edges(steps[path]);
    }
}

Extent JoinBoxes(const BoxArrays& boxes, std::uint32_t first) {
    LanesOfExtent all = boxes_at(boxes, first);
    for (std::size_t i = hn::Lanes(Tag()); i < fan_out; i += hn::Lanes(Tag())) {
        const LanesOfExtent more = boxes_at(boxes, first + i);
        all = {hn::Min(all.low_x, more.low_x), hn::Min(all.low_y, more.low_y),
               hn::Max(all.high_x, more.high_x), hn::Max(all.high_y, more.high_y)};
    }
    return {min_lane(all.low_x), min_lane(all.low_y), max_lane(all.high_x), max_lane(all.high_y)};
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(ForEdgesNear);
HWY_EXPORT(ForClosestToFew);
HWY_EXPORT(MeasureBoxes);
HWY_EXPORT(TakeSteps);
HWY_EXPORT(JoinBoxes);

void for_edges_near(const AabbTree& tree, double x, double y, double bound,
                    const BoundedEdgeSink& sink) {
    HWY_DYNAMIC_DISPATCH(ForEdgesNear)(tree, x, y, bound, sink);
}

double for_closest_to_few(const FewEdges& few, const AabbTree& tree, double most, double margin,
                          const NearPairSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForClosestToFew)(few, tree, most, margin, sink);
}

void measure_boxes(const BoxArrays& boxes, std::uint32_t first, const Extent& from,
                   BoxKeys& squared) {
    HWY_DYNAMIC_DISPATCH(MeasureBoxes)(boxes, first, from, squared);
}

void take_steps(std::span<PathStep> steps, const PathLists& paths) {
    HWY_DYNAMIC_DISPATCH(TakeSteps)(steps, paths);
}

Extent join_boxes(const BoxArrays& boxes, std::uint32_t first) {
    return HWY_DYNAMIC_DISPATCH(JoinBoxes)(boxes, first);
}

}  // namespace nearfield::simd::kernels
#endif
