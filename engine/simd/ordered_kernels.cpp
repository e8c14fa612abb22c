#include <engine/simd/ordered_search.hpp>

#include <algorithm>
#include <bit>
#include <limits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/ordered_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/box_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// A path with what the test against boxes needs.
struct PathLanes {
    Lanes from_x;
    Lanes from_y;
    Lanes inverse_x;  ///< 1 / extent along x; large but finite if there is none
    Lanes inverse_y;

    explicit HWY_INLINE PathLanes(const Path& path)
        : from_x(hn::Set(Tag(), path.from_x)),
          from_y(hn::Set(Tag(), path.from_y)),
          inverse_x(hn::Set(Tag(), Inverse(path.to_x - path.from_x))),
          inverse_y(hn::Set(Tag(), Inverse(path.to_y - path.from_y))) {}

private:
    /// Finite, so that its product with zero is zero.
    static HWY_INLINE double Inverse(double extent) {
        constexpr double smallest = 1e-300;
        return extent > smallest || extent < -smallest ? 1.0 / extent : 1.0 / smallest;
    }
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
        double keys[fan_out];
        // Boxes that hold nothing have an infinite key, and a bound may be infinite.
        const Lanes most = hn::Set(tag, std::min(aim_.bound(), std::numeric_limits<double>::max()));
        std::uint32_t left = 0;
        Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes own = aim_.Keys(boxes_at(tree_.level(level), first + i));
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

/// The edges along a path.
class AlongPath {
public:
    HWY_INLINE AlongPath(const AabbTree& tree, const Path& path, double margin, double bound,
                         const BoundedEdgeSink& sink)
        : tree_(tree),
          lanes_(path),
          // Twice the margin, because the values that boxes are compared by are rounded too.
          margin_(hn::Set(Tag(), 2.0 * margin)),
          path_{1, &path.from_x, &path.from_y, &path.to_x, &path.to_y, nullptr},
          own_margin_(margin),
          sink_(sink),
          bound_(bound) {}

    [[nodiscard]] HWY_INLINE Lanes Keys(const LanesOfExtent& boxes) const {
        return entries(boxes, lanes_, margin_);
    }
    [[nodiscard]] HWY_INLINE double bound() const { return bound_; }
    HWY_INLINE void Use(std::uint32_t box) {
        const EdgeRange range = tree_.edges_of(box);
        std::uint32_t found = bits_of_eight([&](std::size_t i) HWY_ATTR {
            return may_meet(path_, 0, EdgeLanes(tree_.edges(), range.first + i), own_margin_);
        });
        for (found &= bits_of_range(range); found != 0; found &= found - 1) {
            bound_ = sink_.use(sink_.user,
                               range.first + static_cast<std::uint32_t>(std::countr_zero(found)));
        }
    }

private:
    const AabbTree& tree_;
    PathLanes lanes_;
    Lanes margin_;
    EdgeArrays path_;
    double own_margin_;
    const BoundedEdgeSink& sink_;
    double bound_;
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
            bound_ = sink_.use(sink_.user,
                               range.first + static_cast<std::uint32_t>(std::countr_zero(found)));
        }
    }

private:
    const AabbTree& tree_;
    LanesOfExtent point_;
    const BoundedEdgeSink& sink_;
    double bound_;
};

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
                       const VertexAndEdgeSink& sink)
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
    [[nodiscard]] HWY_INLINE double bound() const { return go_on_ ? bound_.squared() : -1.0; }
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
        FindNearVertices(lanes_of(box_at(tree_.level(0), box)), least_ahead, range);
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
                Take(squared_distances(along, hn::Set(tag, few_.start_x[vertex]),
                                       hn::Set(tag, few_.start_y[vertex])),
                     static_cast<std::uint32_t>(i), range.end, vertex, true);
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
                Take(squared_distances(along, x, y), static_cast<std::uint32_t>(i), few_.count,
                     vertex, false);
            }
        }
    }

    /// Passes on the edges of those from `first` on, and before `end`, that are near a vertex.
    HWY_INLINE void Take(Lanes squared, std::uint32_t first, std::uint32_t end,
                         std::uint32_t vertex, bool vertex_of_first) {
        const Tag tag;
        std::uint32_t found = bits_of(hn::Le(squared, hn::Set(tag, bound())));
        if (found == 0) {
            return;
        }
        double distances[max_lanes];
        hn::StoreU(squared, tag, distances);
        for (; found != 0; found &= found - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(found));
            if (first + lane < end && distances[lane] <= bound()) {
                bound_.Take(distances[lane]);
                go_on_ =
                    sink_.use(sink_.user, {vertex, first + lane, vertex_of_first, distances[lane]});
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
    const VertexAndEdgeSink& sink_;
    bool go_on_ = true;
};

void ForEdgesAlong(const AabbTree& tree, const Path& path, double margin, double bound,
                   const BoundedEdgeSink& sink) {
    AlongPath aim(tree, path, margin, bound, sink);
    OrderedSearch<AlongPath>(tree, aim).Run();
}

void ForEdgesNear(const AabbTree& tree, double x, double y, double bound,
                  const BoundedEdgeSink& sink) {
    NearPoint aim(tree, x, y, bound, sink);
    OrderedSearch<NearPoint>(tree, aim).Run();
}

double ForClosestToFew(const FewEdges& few, const AabbTree& tree, double most, double margin,
                       const VertexAndEdgeSink& sink) {
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

void EnterBoxes(const BoxArrays& boxes, std::uint32_t first, const Path& path, double margin,
                BoxKeys& parameters) {
    const PathLanes lanes(path);
    const Lanes grow = hn::Set(Tag(), margin);
    for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
        hn::StoreU(entries(boxes_at(boxes, first + i), lanes, grow), Tag(), parameters.data() + i);
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

HWY_EXPORT(ForEdgesAlong);
HWY_EXPORT(ForEdgesNear);
HWY_EXPORT(ForClosestToFew);
HWY_EXPORT(MeasureBoxes);
HWY_EXPORT(EnterBoxes);
HWY_EXPORT(JoinBoxes);

void for_edges_along(const AabbTree& tree, const Path& path, double margin, double bound,
                     const BoundedEdgeSink& sink) {
    HWY_DYNAMIC_DISPATCH(ForEdgesAlong)(tree, path, margin, bound, sink);
}

void for_edges_near(const AabbTree& tree, double x, double y, double bound,
                    const BoundedEdgeSink& sink) {
    HWY_DYNAMIC_DISPATCH(ForEdgesNear)(tree, x, y, bound, sink);
}

double for_closest_to_few(const FewEdges& few, const AabbTree& tree, double most, double margin,
                          const VertexAndEdgeSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForClosestToFew)(few, tree, most, margin, sink);
}

void measure_boxes(const BoxArrays& boxes, std::uint32_t first, const Extent& from,
                   BoxKeys& squared) {
    HWY_DYNAMIC_DISPATCH(MeasureBoxes)(boxes, first, from, squared);
}

void enter_boxes(const BoxArrays& boxes, std::uint32_t first, const Path& path, double margin,
                 BoxKeys& parameters) {
    HWY_DYNAMIC_DISPATCH(EnterBoxes)(boxes, first, path, margin, parameters);
}

Extent join_boxes(const BoxArrays& boxes, std::uint32_t first) {
    return HWY_DYNAMIC_DISPATCH(JoinBoxes)(boxes, first);
}

}  // namespace nearfield::simd::kernels
#endif
