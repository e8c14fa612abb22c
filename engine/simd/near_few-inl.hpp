// Part of ordered_kernels.cpp, per instruction set.

#include <engine/simd/ordered_search.hpp>

#include <bit>
#include <limits>

// An include guard per instruction set, as Highway prescribes.
#if defined(NEARFIELD_EXACT_NEAR_FEW_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NEARFIELD_EXACT_NEAR_FEW_INL_HPP
#undef NEARFIELD_EXACT_NEAR_FEW_INL_HPP
#else
#define NEARFIELD_EXACT_NEAR_FEW_INL_HPP
#endif

#include <engine/simd/box_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// How far points and boxes are ahead of something, in one direction: nothing of it is nearer.
class Ahead {
public:
    explicit HWY_INLINE Ahead(const double* direction)
        : x_(hn::Set(Tag(), direction[0])),
          y_(hn::Set(Tag(), direction[1])),
          to_right_(hn::Gt(x_, hn::Zero(Tag()))),
          upwards_(hn::Gt(y_, hn::Zero(Tag()))) {}

    /// Of points, from the origin.
    [[nodiscard]] HWY_INLINE Lanes of(Lanes x, Lanes y) const {
        return hn::Add(hn::Mul(x_, x), hn::Mul(y_, y));
    }
    /// Of the corners of boxes that are least far ahead.
    [[nodiscard]] HWY_INLINE Lanes of(const LanesOfExtent& boxes) const {
        return of(hn::IfThenElse(to_right_, boxes.low_x, boxes.high_x),
                  hn::IfThenElse(upwards_, boxes.low_y, boxes.high_y));
    }

private:
    Lanes x_;
    Lanes y_;
    LaneMask to_right_;
    LaneMask upwards_;
};

/// The square of what is left of a length, or 0.
HWY_INLINE Lanes squared_positive(Lanes length) {
    const Lanes left = hn::Max(length, hn::Zero(Tag()));
    return hn::Mul(left, left);
}

/// Vertices and edges near a shape of few edges, which is tested as a whole against each box.
class NearFew {
    static_assert(max_few_edges <= 32, "one bit per vertex");

public:
    HWY_INLINE NearFew(const FewEdges& few, const AabbTree& tree, double most, double margin,
                       const NearPairSink& sink)
        : few_(few.edges),
          box_(lanes_of(few.box)),
          ahead_(few.direction),
          margin_(hn::Set(Tag(), margin)),
          tree_(tree),
          bound_(most, margin),
          sink_(sink) {
        const Tag tag;
        Lanes most_ahead = hn::Set(tag, -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < few_.count; i += hn::Lanes(tag)) {
            const Lanes ahead =
                ahead_.of(hn::LoadU(tag, few_.start_x + i), hn::LoadU(tag, few_.start_y + i));
            hn::StoreU(ahead, tag, few_ahead_ + i);
            most_ahead = hn::Max(most_ahead, ahead);
        }
        most_ahead_ = hn::Set(tag, max_lane(most_ahead) + margin);
    }

    [[nodiscard]] HWY_INLINE Lanes Keys(const LanesOfExtent& boxes) const {
        const Lanes squared = squared_between(boxes, box_);
        const Lanes other = squared_positive(hn::Sub(ahead_.of(boxes), most_ahead_));
        // Not the maximum: boxes that hold nothing may be neither ahead nor behind.
        return hn::IfThenElse(hn::Gt(other, squared), other, squared);
    }
    [[nodiscard]] HWY_INLINE double bound() const { return bound_.squared(); }
    [[nodiscard]] HWY_INLINE double least() const { return bound_.least(); }
    HWY_INLINE void Use(std::uint32_t box) {
        const Tag tag;
        const EdgeRange range = tree_.edges_of(box);
        // Edges that are read, but not in the range, only make this less.
        Lanes ahead = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::size_t i = range.first; i < range.end; i += hn::Lanes(tag)) {
            const EdgeLanes edges(tree_.edges(), i);
            ahead = hn::Min(ahead, hn::Min(ahead_.of(edges.start_x, edges.start_y),
                                           ahead_.of(edges.end_x, edges.end_y)));
        }
        const Lanes least_ahead = hn::Set(tag, min_lane(ahead));
        FindNearVertices(lanes_of(tree_.box(0, box)), least_ahead, range);
        FindNearEdges(range);
    }

private:
    /// Tests the vertices of the few against the edges of a box.
    HWY_INLINE void FindNearVertices(const LanesOfExtent& box, Lanes least_ahead,
                                     const EdgeRange& range) {
        const Tag tag;
        const Lanes from = hn::Sub(least_ahead, margin_);
        std::uint32_t near = 0;
        for (std::uint32_t i = 0; i < few_.count; i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
            const Lanes x = hn::LoadU(tag, few_.start_x + i);
            const Lanes y = hn::LoadU(tag, few_.start_y + i);
            const Lanes most = hn::Set(tag, bound());
            const LaneMask may_be_near = hn::And(
                hn::Le(squared_positive(hn::Sub(from, hn::LoadU(tag, few_ahead_ + i))), most),
                hn::Le(squared_between(box, {x, y, x, y}), most));
            near |= bits_of(may_be_near) << i;
        }
        near &= bits_of_range({0, few_.count});
        if (near == 0) {
            return;
        }
        for (std::size_t i = range.first; i < range.end; i += hn::Lanes(tag)) {
            const EdgesAlong along = edges_along(tree_.edges(), i);
            for (std::uint32_t left = near; left != 0; left &= left - 1) {
                const auto vertex = static_cast<std::uint32_t>(std::countr_zero(left));
                const Lanes x = hn::Set(tag, few_.start_x[vertex]);
                const Lanes y = hn::Set(tag, few_.start_y[vertex]);
                Take(squared_distances(along, x, y), x, y, tree_.edges(),
                     {static_cast<std::uint32_t>(i), range.end}, vertex, true);
            }
        }
    }

    /// Tests the vertices where the edges of a box start against the edges of the few.
    HWY_INLINE void FindNearEdges(const EdgeRange& range) {
        const Tag tag;
        const EdgeArrays& edges = tree_.edges();
        std::uint32_t near = bits_of_eight([&](std::size_t i) HWY_ATTR {
            const Lanes x = hn::LoadU(tag, edges.start_x + range.first + i);
            const Lanes y = hn::LoadU(tag, edges.start_y + range.first + i);
            const Lanes most = hn::Set(tag, bound());
            return hn::And(hn::Le(squared_positive(hn::Sub(ahead_.of(x, y), most_ahead_)), most),
                           hn::Le(squared_between(box_, {x, y, x, y}), most));
        });
        for (near &= bits_of_range(range); near != 0; near &= near - 1) {
            const std::uint32_t vertex =
                range.first + static_cast<std::uint32_t>(std::countr_zero(near));
            const Lanes x = hn::Set(tag, edges.start_x[vertex]);
            const Lanes y = hn::Set(tag, edges.start_y[vertex]);
            for (std::size_t i = 0; i < few_.count; i += hn::Lanes(tag)) {
                EdgesAlong along(few_, i);
                along.inverse_length = hn::LoadU(tag, few_.inverse_length + i);
                Take(squared_distances(along, x, y), x, y, few_,
                     {static_cast<std::uint32_t>(i), few_.count}, vertex, false);
            }
        }
    }

    /// Passes on those of a vector of edges, as far as they are in the range, that are near a
    /// vertex, which is at x and y.
    HWY_INLINE void Take(Lanes squared, Lanes x, Lanes y, const EdgeArrays& edges,
                         const EdgeRange& range, std::uint32_t vertex, bool vertex_of_first) {
        const Tag tag;
        std::uint32_t found = bits_of(hn::Le(squared, hn::Set(tag, bound())));
        if (found == 0) {
            return;
        }
        double distances[max_lanes];
        double exact[max_lanes];
        hn::StoreU(squared, tag, distances);
        hn::StoreU(nearest_on_edges(EdgeLanes(edges, range.first), x, y).squared, tag, exact);
        for (; found != 0; found &= found - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(found));
            if (range.first + lane < range.end && distances[lane] <= bound()) {
                bound_.Take(distances[lane]);
                sink_(
                    {{vertex, range.first + lane, vertex_of_first, distances[lane]}, exact[lane]});
            }
        }
    }

    const EdgeArrays& few_;
    LanesOfExtent box_;
    Ahead ahead_;
    Lanes most_ahead_;  // of the few, and the margin
    Lanes margin_;
    double few_ahead_[max_few_edges];
    const AabbTree& tree_;
    LeastBound bound_;
    const NearPairSink& sink_;
};

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
