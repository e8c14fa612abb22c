#include <engine/base/interruption.hpp>
#include <engine/simd/aabb_tree.hpp>

#include <bit>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/tree_pair_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/box_lanes-inl.hpp>
#include <engine/simd/oriented_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// A box of a tree, oriented if there are such boxes, in every lane.
HWY_INLINE OrientedLanes oriented_box(const AabbTree& tree, std::uint32_t level,
                                      std::uint32_t box) {
    const Tag tag;
    if (const EdgesOnDemand* const own = tree.on_demand(); own != nullptr) {
        const geometry::EdgeBoxes::Group& group = own->group(level, box / fan_out);
        const geometry::Placement placement = own->placement();
        const std::uint32_t i = box % fan_out;
        const auto turned = [&](std::size_t axis, double x, double y) {
            return placement.x_axis[axis] * x + placement.y_axis[axis] * y;
        };
        return {hn::Set(tag, turned(0, group.x[i], group.y[i]) + placement.translation[0]),
                hn::Set(tag, turned(1, group.x[i], group.y[i]) + placement.translation[1]),
                hn::Set(tag, turned(0, group.along_x[i], group.along_y[i])),
                hn::Set(tag, turned(1, group.along_x[i], group.along_y[i])),
                hn::Set(tag, group.half_along[i]),
                hn::Set(tag, group.half_across[i] + own->allowance())};
    }
    const Extent extent = tree.box(level, box);
    return {hn::Set(tag, 0.5 * (extent.low_x + extent.high_x)),
            hn::Set(tag, 0.5 * (extent.low_y + extent.high_y)),
            hn::Set(tag, 1.0),
            hn::Zero(tag),
            hn::Set(tag, 0.5 * (extent.high_x - extent.low_x)),
            hn::Set(tag, 0.5 * (extent.high_y - extent.low_y))};
}

/// Traverses two trees together, down to pairs of lowest boxes. `Leaves` prunes and handles the
/// pairs:
///   bool by_oriented_boxes          whether oriented boxes are compared, too
///   Lanes squared_bound()           pairs farther apart than its root are pruned
///   bool Use(box_a, box_b)          a pair of lowest boxes; returns whether to go on
template <class Leaves>
class PairWalk {
public:
    HWY_INLINE PairWalk(const AabbTree& a, const AabbTree& b, Leaves& leaves, VisitsLeft& left)
        : a_(a), b_(b), leaves_(leaves), left_(left) {}

    bool Run() {
        const std::uint32_t top = a_.top_level();
        for (std::uint32_t i = 0; i < a_.count(top); ++i) {
            if (!OpenB(top, i, b_.top_level(), 0)) {
                return false;
            }
        }
        return true;
    }

private:
    /// Tests boxes of A from `first` on against one box of B.
    bool OpenA(std::uint32_t level_a, std::uint32_t first, std::uint32_t level_b,
               std::uint32_t box_b) {
        return Open(a_, level_a, first, b_, level_b, box_b, [&](std::uint32_t box_a) HWY_ATTR {
            return Visit(level_a, box_a, level_b, box_b);
        });
    }

    bool OpenB(std::uint32_t level_a, std::uint32_t box_a, std::uint32_t level_b,
               std::uint32_t first) {
        return Open(b_, level_b, first, a_, level_a, box_a, [&](std::uint32_t box_b) HWY_ATTR {
            return Visit(level_a, box_a, level_b, box_b);
        });
    }

    template <class Use>
    HWY_INLINE bool Open(const AabbTree& tree, std::uint32_t level, std::uint32_t first,
                         const AabbTree& other, std::uint32_t level_of_other,
                         std::uint32_t box_of_other, const Use& use) {
        const Tag tag;
        const BoxArrays& boxes = tree.boxes(level, first);
        const LanesOfExtent bounds = lanes_of(other.box(level_of_other, box_of_other));
        double squared[fan_out];
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes distances = squared_between(boxes_at(boxes, first + i), bounds);
            hn::StoreU(distances, tag, squared + i);
            bits |= bits_of(hn::Le(distances, hn::Set(tag, leaves_.squared_bound()))) << i;
        }
        if constexpr (Leaves::by_oriented_boxes) {
            if (bits != 0 && tree.on_demand() != nullptr) {
                Narrow(*tree.on_demand(), level, first,
                       oriented_box(other, level_of_other, box_of_other), squared);
            }
        }
        for (; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
            if (squared[i] <= leaves_.squared_bound() && !use(first + i)) {
                return false;
            }
        }
        return true;
    }

    /// Raises the squared distances of eight boxes from another.
    static HWY_INLINE void Narrow(const EdgesOnDemand& edges, std::uint32_t level,
                                  std::uint32_t first, const OrientedLanes& other,
                                  double* squared) {
        const Tag tag;
        const geometry::EdgeBoxes::Group& group = edges.group(level, first / fan_out);
        const geometry::Placement placement = edges.placement();
        const Lanes allowance = hn::Set(tag, edges.allowance());
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes gaps = gaps_between(oriented_at(group, i, placement), other);
            const Lanes sure = hn::Max(hn::Sub(gaps, allowance), hn::Zero(tag));
            hn::StoreU(hn::Max(hn::LoadU(tag, squared + i), hn::Mul(sure, sure)), tag, squared + i);
        }
    }

    bool Visit(std::uint32_t level_a, std::uint32_t box_a, std::uint32_t level_b,
               std::uint32_t box_b) {
        checkpoint_.step();
        if (left_.count == 0) {
            return false;
        }
        --left_.count;
        if (level_a == 0 && level_b == 0) {
            return leaves_.Use(box_a, box_b);
        }
        return level_a >= level_b ? OpenA(level_a - 1, fan_out * box_a, level_b, box_b)
                                  : OpenB(level_a, box_a, level_b - 1, fan_out * box_b);
    }

    const AabbTree& a_;
    const AabbTree& b_;
    Leaves& leaves_;
    VisitsLeft& left_;
    SparseCheckpoint<1024> checkpoint_;
};

class IntersectingLeaves {
public:
    static constexpr bool by_oriented_boxes = false;

    HWY_INLINE IntersectingLeaves(const AabbTree& a, const AabbTree& b, double margin,
                                  const EdgePairSink& sink)
        : a_(a), b_(b), margin_(margin), sink_(sink) {}

    /// Boxes `margin_` apart along both axes are twice that apart, squared; increased for rounding.
    [[nodiscard]] HWY_INLINE double squared_bound() const { return 8.0 * margin_ * margin_; }

    bool Use(std::uint32_t box_a, std::uint32_t box_b) {
        const EdgeArrays& a = a_.edges();
        const EdgeArrays& b = b_.edges();
        const EdgeRange of_a = a_.edges_of(box_a);
        const EdgeRange of_b = b_.edges_of(box_b);
        const LanesOfExtent box = lanes_of(grown(b_.box(0, box_b), 2.0 * margin_));
        std::uint32_t near = bits_of_eight(
            [&](std::size_t i) HWY_ATTR { return meet(box, EdgeLanes(a, of_a.first + i)); });
        for (near &= bits_of_range(of_a); near != 0; near &= near - 1) {
            const std::uint32_t edge =
                of_a.first + static_cast<std::uint32_t>(std::countr_zero(near));
            // Twice the margin, because the values that two boxes are compared by are rounded too.
            const LanesOfExtent bounds = lanes_of(extent_of(a, edge, 2.0 * margin_));
            std::uint32_t found = bits_of_eight([&](std::size_t i) HWY_ATTR {
                const EdgeLanes others(b, of_b.first + i);
                return hn::And(meet(bounds, others), may_meet(a, edge, others, margin_));
            });
            for (found &= bits_of_range(of_b); found != 0; found &= found - 1) {
                const std::uint32_t other =
                    of_b.first + static_cast<std::uint32_t>(std::countr_zero(found));
                if (!sink_({edge, other})) {
                    return false;
                }
            }
        }
        return true;
    }

private:
    const AabbTree& a_;
    const AabbTree& b_;
    double margin_;
    const EdgePairSink& sink_;
};

bool ForCandidatePairs(const AabbTree& first, const AabbTree& second, double margin,
                       const EdgePairSink& sink, VisitsLeft& left) {
    IntersectingLeaves leaves(first, second, margin, sink);
    return !PairWalk<IntersectingLeaves>(first, second, leaves, left).Run();
}

/// Finds vertices of either shape and edges of the other within a bound, which `Bound` lowers as
/// pairs are found.
template <class Bound>
class NearLeaves {
public:
    static constexpr bool by_oriented_boxes = true;

    HWY_INLINE NearLeaves(const AabbTree& a, const AabbTree& b, Bound& bound,
                          const VertexAndEdgeSink& sink)
        : a_(a), b_(b), bound_(bound), sink_(sink) {}

    [[nodiscard]] HWY_INLINE double squared_bound() const { return bound_.squared(); }

    bool Use(std::uint32_t box_a, std::uint32_t box_b) {
        return FindNear(a_, box_a, b_, box_b, true) && FindNear(b_, box_b, a_, box_a, false);
    }

private:
    /// Tests the vertices of some edges against other edges; returns whether to go on.
    bool FindNear(const AabbTree& of_vertices, std::uint32_t box_of_vertices,
                  const AabbTree& of_edges, std::uint32_t box_of_edges, bool vertices_are_of_a) {
        const Tag tag;
        const EdgeArrays& vertices = of_vertices.edges();
        const EdgeArrays& edges = of_edges.edges();
        const EdgeRange some_vertices = of_vertices.edges_of(box_of_vertices);
        const EdgeRange some_edges = of_edges.edges_of(box_of_edges);
        const LanesOfExtent box = lanes_of(of_edges.box(0, box_of_edges));
        std::uint32_t near = bits_of_eight([&](std::size_t i) HWY_ATTR {
            const Lanes x = hn::LoadU(tag, vertices.start_x + some_vertices.first + i);
            const Lanes y = hn::LoadU(tag, vertices.start_y + some_vertices.first + i);
            return hn::Le(squared_between(box, {x, y, x, y}), hn::Set(tag, squared_bound()));
        });
        near &= bits_of_range(some_vertices);
        if (near == 0) {
            return true;
        }
        for (std::size_t i = some_edges.first; i < some_edges.end; i += hn::Lanes(tag)) {
            const EdgesAlong along = edges_along(edges, i);
            for (std::uint32_t left = near; left != 0; left &= left - 1) {
                const std::uint32_t vertex =
                    some_vertices.first + static_cast<std::uint32_t>(std::countr_zero(left));
                const Lanes squared =
                    squared_distances(along, hn::Set(tag, vertices.start_x[vertex]),
                                      hn::Set(tag, vertices.start_y[vertex]));
                std::uint32_t found = bits_of(hn::Le(squared, hn::Set(tag, squared_bound())));
                if (found == 0) {
                    continue;
                }
                double distances[max_lanes];
                hn::StoreU(squared, tag, distances);
                for (; found != 0; found &= found - 1) {
                    const auto lane = static_cast<std::uint32_t>(std::countr_zero(found));
                    const auto edge = static_cast<std::uint32_t>(i) + lane;
                    if (edge >= some_edges.end || distances[lane] > squared_bound()) {
                        continue;
                    }
                    bound_.Take(distances[lane]);
                    if (!sink_({vertex, edge, vertices_are_of_a, distances[lane]})) {
                        return false;
                    }
                }
            }
        }
        return true;
    }

    const AabbTree& a_;
    const AabbTree& b_;
    Bound& bound_;
    const VertexAndEdgeSink& sink_;
};

class FixedBound {
public:
    HWY_INLINE explicit FixedBound(double squared) : squared_(squared) {}

    [[nodiscard]] HWY_INLINE double squared() const { return squared_; }
    HWY_INLINE void Take(double /*squared*/) const {}

private:
    double squared_;
};

double ForClosest(const AabbTree& first, const AabbTree& second, double most, double margin,
                  const VertexAndEdgeSink& sink) {
    LeastBound bound(most, margin);
    NearLeaves<LeastBound> leaves(first, second, bound, sink);
    VisitsLeft unlimited;
    PairWalk<NearLeaves<LeastBound>>(first, second, leaves, unlimited).Run();
    return bound.least();
}

bool ForWithin(const AabbTree& first, const AabbTree& second, double most,
               const VertexAndEdgeSink& sink) {
    FixedBound bound(most);
    NearLeaves<FixedBound> leaves(first, second, bound, sink);
    VisitsLeft unlimited;
    return !PairWalk<NearLeaves<FixedBound>>(first, second, leaves, unlimited).Run();
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(ForCandidatePairs);
HWY_EXPORT(ForClosest);
HWY_EXPORT(ForWithin);

bool for_candidate_pairs(const AabbTree& first, const AabbTree& second, double margin,
                         const EdgePairSink& sink, VisitsLeft& left) {
    return HWY_DYNAMIC_DISPATCH(ForCandidatePairs)(first, second, margin, sink, left);
}

double for_closest(const AabbTree& first, const AabbTree& second, double most, double margin,
                   const VertexAndEdgeSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForClosest)(first, second, most, margin, sink);
}

bool for_within(const AabbTree& first, const AabbTree& second, double most,
                const VertexAndEdgeSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForWithin)(first, second, most, sink);
}

}  // namespace nearfield::simd::kernels
#endif
