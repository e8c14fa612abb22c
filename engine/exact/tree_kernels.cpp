#include <engine/exact/box_tree.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

// Highway compiles what follows once for every instruction set, by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/exact/tree_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/exact/lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::exact::kernels::HWY_NAMESPACE {

constexpr std::uint32_t fan_out = BoxTree::fan_out;

/// The bits of eight comparisons; `compare(i)` makes those of lanes i, i + 1, ...
template <class Compare>
HWY_INLINE std::uint32_t bits_of_eight(const Compare& compare) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
        bits |= bits_of(compare(i)) << i;
    }
    return bits;
}

/// Of the boxes i, i + 1, ...
HWY_INLINE LanesOfExtent boxes_at(const BoxArrays& boxes, std::size_t i) {
    const Tag tag;
    return {hn::LoadU(tag, boxes.low_x + i), hn::LoadU(tag, boxes.low_y + i),
            hn::LoadU(tag, boxes.high_x + i), hn::LoadU(tag, boxes.high_y + i)};
}

HWY_INLINE Extent box_at(const BoxArrays& boxes, std::size_t i) {
    return {boxes.low_x[i], boxes.low_y[i], boxes.high_x[i], boxes.high_y[i]};
}

/// Between boxes, lane by lane; 0 where they meet. A point is a box too.
HWY_INLINE Lanes squared_between(const LanesOfExtent& a, const LanesOfExtent& b) {
    const Lanes zero = hn::Zero(Tag());
    const Lanes off_x =
        hn::Max(hn::Max(hn::Sub(a.low_x, b.high_x), hn::Sub(b.low_x, a.high_x)), zero);
    const Lanes off_y =
        hn::Max(hn::Max(hn::Sub(a.low_y, b.high_y), hn::Sub(b.low_y, a.high_y)), zero);
    return hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
}

HWY_INLINE LaneMask meet(const LanesOfExtent& a, const LanesOfExtent& b) {
    return hn::And(hn::And(hn::Le(a.low_x, b.high_x), hn::Le(b.low_x, a.high_x)),
                   hn::And(hn::Le(a.low_y, b.high_y), hn::Le(b.low_y, a.high_y)));
}

HWY_INLINE Extent grown(const Extent& box, double by) {
    return {box.low_x - by, box.low_y - by, box.high_x + by, box.high_y + by};
}

/// Of the edges i, i + 1, ..., their lengths included.
HWY_INLINE EdgesAlong edges_along(const EdgeArrays& edges, std::size_t i) {
    EdgesAlong along(edges, i);
    const Lanes squared =
        hn::Add(hn::Mul(along.along_x, along.along_x), hn::Mul(along.along_y, along.along_y));
    along.inverse_length = hn::Div(hn::Set(Tag(), 1.0), squared);
    return along;
}

// ---- building ------------------------------------------------------------------------------

void FindEdgeBoxes(const EdgeArrays& edges, double* boxes, std::size_t length) {
    const Tag tag;
    for (std::size_t i = 0; i < edges.count; i += fan_out) {
        const EdgeLanes first(edges, i);
        Lanes low_x = hn::Min(first.start_x, first.end_x);
        Lanes low_y = hn::Min(first.start_y, first.end_y);
        Lanes high_x = hn::Max(first.start_x, first.end_x);
        Lanes high_y = hn::Max(first.start_y, first.end_y);
        for (std::size_t k = hn::Lanes(tag); k < fan_out; k += hn::Lanes(tag)) {
            const EdgeLanes more(edges, i + k);
            low_x = hn::Min(low_x, hn::Min(more.start_x, more.end_x));
            low_y = hn::Min(low_y, hn::Min(more.start_y, more.end_y));
            high_x = hn::Max(high_x, hn::Max(more.start_x, more.end_x));
            high_y = hn::Max(high_y, hn::Max(more.start_y, more.end_y));
        }
        double* const box = boxes + i / fan_out;
        box[0] = least_lane(low_x);
        box[length] = least_lane(low_y);
        box[2 * length] = greatest_lane(high_x);
        box[3 * length] = greatest_lane(high_y);
    }
}

/// Boxes over eight boxes each, which are `length` apart from side to side.
void FindBoxesOver(const BoxArrays& below, double* boxes, std::size_t length) {
    const Tag tag;
    for (std::size_t i = 0; i < below.count; i += fan_out) {
        LanesOfExtent all = boxes_at(below, i);
        for (std::size_t k = hn::Lanes(tag); k < fan_out; k += hn::Lanes(tag)) {
            const LanesOfExtent more = boxes_at(below, i + k);
            all = {hn::Min(all.low_x, more.low_x), hn::Min(all.low_y, more.low_y),
                   hn::Max(all.high_x, more.high_x), hn::Max(all.high_y, more.high_y)};
        }
        double* const box = boxes + i / fan_out;
        box[0] = least_lane(all.low_x);
        box[length] = least_lane(all.low_y);
        box[2 * length] = greatest_lane(all.high_x);
        box[3 * length] = greatest_lane(all.high_y);
    }
}

void FindBoxes(const EdgeArrays& edges, double* boxes) {
    const BoxTree tree(edges, boxes);
    for (std::uint32_t level = 0; level <= tree.top_level(); ++level) {
        const std::uint32_t count = tree.level(level).count;
        const std::size_t length = padded(count);
        if (level == 0) {
            FindEdgeBoxes(edges, boxes, length);
        } else {
            FindBoxesOver(tree.level(level - 1), boxes, length);
        }
        for (std::size_t i = count; i < length; ++i) {
            boxes[i] = boxes[length + i] = std::numeric_limits<double>::infinity();
            boxes[2 * length + i] = boxes[3 * length + i] =
                -std::numeric_limits<double>::infinity();
        }
        boxes += 4 * length;
    }
}

// ---- one point -----------------------------------------------------------------------------

/// Calls `use(i)` for the first edge of each box of the lowest level that is entered with all boxes
/// above it, as long as it says so; `enter(boxes)` says which of some boxes are.
template <class Enter, class Use>
HWY_INLINE void for_leaves(const BoxTree& tree, const Enter& enter, const Use& use) {
    // A stack of what is left of eight boxes, a level each.
    std::uint32_t bits[10];
    std::uint32_t first[10];
    const auto open = [&](std::uint32_t level, std::uint32_t begin) HWY_ATTR {
        first[level] = begin;
        bits[level] = bits_of_eight(
            [&](std::size_t i) HWY_ATTR { return enter(boxes_at(tree.level(level), begin + i)); });
    };
    const std::uint32_t top = tree.top_level();
    std::uint32_t level = top;
    open(top, 0);
    for (;;) {
        if (bits[level] == 0) {
            if (level == top) {
                return;
            }
            ++level;
            continue;
        }
        const std::uint32_t child =
            fan_out * (first[level] + static_cast<std::uint32_t>(std::countr_zero(bits[level])));
        bits[level] &= bits[level] - 1;
        if (level == 0) {
            if (!use(child)) {
                return;
            }
        } else {
            --level;
            open(level, child);
        }
    }
}

bool ContainByTree(const BoxTree& tree, double point_x, double point_y) {
    const Tag tag;
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    Lanes odd = hn::Zero(tag);
    for_leaves(
        tree,
        [&](const LanesOfExtent& boxes) HWY_ATTR {
            return hn::And(hn::Ge(boxes.high_x, x),
                           hn::And(hn::Le(boxes.low_y, y), hn::Ge(boxes.high_y, y)));
        },
        [&](std::uint32_t leaf) HWY_ATTR {
            for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
                odd = hn::Xor(odd, crossings(EdgeLanes(tree.edges(), leaf + i), x, y));
            }
            return true;
        });
    return (std::popcount(bits_of(are_negative(odd))) & 1) != 0;
}

std::uint32_t FindEdgesWithinByTree(const BoxTree& tree, double point_x, double point_y,
                                    double most, std::uint32_t* found) {
    const Tag tag;
    const LanesOfExtent point = lanes_of({point_x, point_y, point_x, point_y});
    const Lanes limit = hn::Set(tag, most);
    std::uint32_t count = 0;
    for_leaves(
        tree,
        [&](const LanesOfExtent& boxes)
            HWY_ATTR { return hn::Le(squared_between(boxes, point), limit); },
        [&](std::uint32_t leaf) HWY_ATTR {
            for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
                const Lanes squared = squared_distances(edges_along(tree.edges(), leaf + i),
                                                        point.low_x, point.low_y);
                count = append_lanes(hn::Le(squared, limit), leaf + i, tree.edges().count, found,
                                     count);
            }
            return true;
        });
    return count;
}

std::uint32_t FindEdgesInByTree(const BoxTree& tree, const Extent& box, std::uint32_t* found) {
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    for_leaves(
        tree, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, bounds); },
        [&](std::uint32_t leaf) HWY_ATTR {
            for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
                count = append_lanes(meet(bounds, EdgeLanes(tree.edges(), leaf + i)), leaf + i,
                                     tree.edges().count, found, count);
            }
            return true;
        });
    return count;
}

bool Meets(const BoxTree& tree, const Extent& box) {
    const LanesOfExtent bounds = lanes_of(box);
    bool found = false;
    for_leaves(
        tree, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, bounds); },
        [&](std::uint32_t leaf) HWY_ATTR {
            found = bits_of_eight([&](std::size_t i) HWY_ATTR {
                        return meet(bounds, EdgeLanes(tree.edges(), leaf + i));
                    }) != 0;
            return !found;
        });
    return found;
}

/// The nearest edge to a point, the nearest box first.
class NearestSearch {
public:
    HWY_INLINE NearestSearch(const BoxTree& tree, double x, double y, const NearEdge& guess)
        : tree_(tree), point_{x, y, x, y}, best_(guess) {}

    void Visit(std::uint32_t level, std::uint32_t first) {
        const Tag tag;
        const LanesOfExtent point = lanes_of(point_);
        double squared[fan_out];
        std::uint32_t bits = 0;
        Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes distances = squared_between(boxes_at(tree_.level(level), first + i), point);
            hn::StoreU(distances, tag, squared + i);
            bits |= bits_of(hn::Lt(distances, hn::Set(tag, best_.squared))) << i;
            least = hn::Min(least, distances);
        }
        if (bits == 0) {
            return;
        }
        if ((bits & (bits - 1)) != 0) {
            // The nearest one first: hardly another is left then.
            const double nearest = least_lane(least);
            for (std::uint32_t i = 0; i < fan_out; ++i) {
                if (squared[i] == nearest) {
                    Enter(level, first + i);
                    bits &= ~(1U << i);
                    break;
                }
            }
        }
        for (; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
            if (squared[i] < best_.squared) {
                Enter(level, first + i);
            }
        }
    }

    [[nodiscard]] HWY_INLINE const NearEdge& best() const { return best_; }

private:
    void Enter(std::uint32_t level, std::uint32_t box) {
        if (level > 0) {
            Visit(level - 1, fan_out * box);
            return;
        }
        const Tag tag;
        const EdgeArrays& edges = tree_.edges();
        const Lanes x = hn::Set(tag, point_.low_x);
        const Lanes y = hn::Set(tag, point_.low_y);
        for (std::size_t i = std::size_t{fan_out} * box; i < fan_out * (box + 1);
             i += hn::Lanes(tag)) {
            const Lanes squared = squared_distances(edges_along(edges, i), x, y);
            if (hn::AllFalse(tag, hn::Lt(squared, hn::Set(tag, best_.squared)))) {
                continue;
            }
            best_ = least_of(squared, hn::Iota(tag, static_cast<double>(i)));
            // What fills up the lanes is no nearer than the last edge, but for its rounding.
            best_.edge = best_.edge < edges.count ? best_.edge : edges.count - 1;
        }
    }

    const BoxTree& tree_;
    Extent point_;
    NearEdge best_;
};

NearEdge FindNearer(const BoxTree& tree, double x, double y, const NearEdge& guess) {
    NearestSearch search(tree, x, y, guess);
    search.Visit(tree.top_level(), 0);
    return search.best();
}

// ---- two trees -----------------------------------------------------------------------------

/// Goes down two trees together, to pairs of boxes of their lowest levels. `Leaves` says which
/// pairs matter and what to do with those:
///   Lanes squared_bound()           no pair farther apart than its root matters
///   bool use(box_a, box_b)          a pair of lowest boxes; whether to go on
template <class Leaves>
class PairWalk {
public:
    HWY_INLINE PairWalk(const BoxTree& a, const BoxTree& b, Leaves& leaves)
        : a_(a), b_(b), leaves_(leaves) {}

    bool Run() {
        const std::uint32_t top = a_.top_level();
        for (std::uint32_t i = 0; i < a_.level(top).count; ++i) {
            if (!OpenB(top, i, b_.top_level(), 0)) {
                return false;
            }
        }
        return true;
    }

private:
    /// Boxes of A from `first` on against one of B.
    bool OpenA(std::uint32_t level_a, std::uint32_t first, std::uint32_t level_b,
               std::uint32_t box_b) {
        return Open(a_.level(level_a), first, box_at(b_.level(level_b), box_b),
                    [&](std::uint32_t box_a)
                        HWY_ATTR { return Visit(level_a, box_a, level_b, box_b); });
    }

    bool OpenB(std::uint32_t level_a, std::uint32_t box_a, std::uint32_t level_b,
               std::uint32_t first) {
        return Open(b_.level(level_b), first, box_at(a_.level(level_a), box_a),
                    [&](std::uint32_t box_b)
                        HWY_ATTR { return Visit(level_a, box_a, level_b, box_b); });
    }

    template <class Use>
    HWY_INLINE bool Open(const BoxArrays& boxes, std::uint32_t first, const Extent& other,
                         const Use& use) {
        const Tag tag;
        const LanesOfExtent bounds = lanes_of(other);
        double squared[fan_out];
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes distances = squared_between(boxes_at(boxes, first + i), bounds);
            hn::StoreU(distances, tag, squared + i);
            bits |= bits_of(hn::Le(distances, hn::Set(tag, leaves_.squared_bound()))) << i;
        }
        for (; bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
            if (squared[i] <= leaves_.squared_bound() && !use(first + i)) {
                return false;
            }
        }
        return true;
    }

    bool Visit(std::uint32_t level_a, std::uint32_t box_a, std::uint32_t level_b,
               std::uint32_t box_b) {
        if (level_a == 0 && level_b == 0) {
            return leaves_.Use(fan_out * box_a, fan_out * box_b);
        }
        return level_a >= level_b ? OpenA(level_a - 1, fan_out * box_a, level_b, box_b)
                                  : OpenB(level_a, box_a, level_b - 1, fan_out * box_b);
    }

    const BoxTree& a_;
    const BoxTree& b_;
    Leaves& leaves_;
};

class MeetingLeaves {
public:
    HWY_INLINE MeetingLeaves(const BoxTree& a, const BoxTree& b, double margin,
                             const EdgePairSink& sink)
        : a_(a), b_(b), margin_(margin), sink_(sink) {}

    /// Boxes so much apart along both axes are twice that apart, squared, and a little more.
    [[nodiscard]] HWY_INLINE double squared_bound() const { return 8.0 * margin_ * margin_; }

    bool Use(std::uint32_t first_a, std::uint32_t first_b) {
        const EdgeArrays& a = a_.edges();
        const EdgeArrays& b = b_.edges();
        const LanesOfExtent box =
            lanes_of(grown(box_at(b_.level(0), first_b / fan_out), 2.0 * margin_));
        std::uint32_t near = bits_of_eight(
            [&](std::size_t i) HWY_ATTR { return meet(box, EdgeLanes(a, first_a + i)); });
        for (; near != 0; near &= near - 1) {
            const std::uint32_t edge = first_a + static_cast<std::uint32_t>(std::countr_zero(near));
            if (edge >= a.count) {
                break;
            }
            // Twice the margin: what two boxes are compared by rounds too.
            const LanesOfExtent bounds = lanes_of(extent_of(a, edge, 2.0 * margin_));
            std::uint32_t found = bits_of_eight([&](std::size_t i) HWY_ATTR {
                const EdgeLanes others(b, first_b + i);
                return hn::And(meet(bounds, others), may_meet(a, edge, others, margin_));
            });
            for (; found != 0; found &= found - 1) {
                const std::uint32_t other =
                    first_b + static_cast<std::uint32_t>(std::countr_zero(found));
                if (other < b.count && !sink_.use(sink_.user, {edge, other})) {
                    return false;
                }
            }
        }
        return true;
    }

private:
    const BoxTree& a_;
    const BoxTree& b_;
    double margin_;
    const EdgePairSink& sink_;
};

bool ForMeetingPairs(const BoxTree& first, const BoxTree& second, double margin,
                     const EdgePairSink& sink) {
    MeetingLeaves leaves(first, second, margin, sink);
    return !PairWalk<MeetingLeaves>(first, second, leaves).Run();
}

class ClosestLeaves {
public:
    HWY_INLINE ClosestLeaves(const BoxTree& a, const BoxTree& b, double most, double margin,
                             const VertexAndEdgeSink& sink)
        : a_(a), b_(b), margin_(margin), sink_(sink), least_(most), bound_(longer(most)) {}

    [[nodiscard]] HWY_INLINE double squared_bound() const { return bound_; }
    [[nodiscard]] HWY_INLINE double least() const { return least_; }

    bool Use(std::uint32_t first_a, std::uint32_t first_b) {
        FindNear(a_, first_a, b_, first_b, true);
        FindNear(b_, first_b, a_, first_a, false);
        return true;
    }

private:
    [[nodiscard]] HWY_INLINE double longer(double squared) const {
        const double length = std::sqrt(squared) + margin_;
        return length * length;
    }

    /// The vertices of some edges against other edges.
    void FindNear(const BoxTree& of_vertices, std::uint32_t first_vertex, const BoxTree& of_edges,
                  std::uint32_t first_edge, bool vertices_are_of_a) {
        const Tag tag;
        const EdgeArrays& vertices = of_vertices.edges();
        const EdgeArrays& edges = of_edges.edges();
        const LanesOfExtent box = lanes_of(box_at(of_edges.level(0), first_edge / fan_out));
        std::uint32_t near = bits_of_eight([&](std::size_t i) HWY_ATTR {
            const Lanes x = hn::LoadU(tag, vertices.start_x + first_vertex + i);
            const Lanes y = hn::LoadU(tag, vertices.start_y + first_vertex + i);
            return hn::Le(squared_between(box, {x, y, x, y}), hn::Set(tag, bound_));
        });
        if (near == 0) {
            return;
        }
        for (std::size_t i = first_edge; i < first_edge + fan_out; i += hn::Lanes(tag)) {
            const EdgesAlong along = edges_along(edges, i);
            for (std::uint32_t left = near; left != 0; left &= left - 1) {
                const std::uint32_t vertex =
                    first_vertex + static_cast<std::uint32_t>(std::countr_zero(left));
                if (vertex >= vertices.count) {
                    break;
                }
                const Lanes squared =
                    squared_distances(along, hn::Set(tag, vertices.start_x[vertex]),
                                      hn::Set(tag, vertices.start_y[vertex]));
                std::uint32_t found = bits_of(hn::Le(squared, hn::Set(tag, bound_)));
                if (found == 0) {
                    continue;
                }
                double distances[most_lanes];
                hn::StoreU(squared, tag, distances);
                for (; found != 0; found &= found - 1) {
                    const auto lane = static_cast<std::uint32_t>(std::countr_zero(found));
                    const auto edge = static_cast<std::uint32_t>(i) + lane;
                    if (edge < edges.count && distances[lane] <= bound_) {
                        Take({vertex, edge, vertices_are_of_a, distances[lane]});
                    }
                }
            }
        }
    }

    void Take(const VertexAndEdge& found) {
        sink_.use(sink_.user, found);
        if (found.squared < least_) {
            least_ = found.squared;
            bound_ = longer(least_);
        }
    }

    const BoxTree& a_;
    const BoxTree& b_;
    double margin_;
    const VertexAndEdgeSink& sink_;
    double least_;
    double bound_;
};

double ForClosest(const BoxTree& first, const BoxTree& second, double most, double margin,
                  const VertexAndEdgeSink& sink) {
    ClosestLeaves leaves(first, second, most, margin, sink);
    PairWalk<ClosestLeaves>(first, second, leaves).Run();
    return leaves.least();
}

}  // namespace nearfield::exact::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::exact::kernels {

HWY_EXPORT(FindBoxes);
HWY_EXPORT(ContainByTree);
HWY_EXPORT(FindNearer);
HWY_EXPORT(FindEdgesWithinByTree);
HWY_EXPORT(FindEdgesInByTree);
HWY_EXPORT(Meets);
HWY_EXPORT(ForMeetingPairs);
HWY_EXPORT(ForClosest);

void find_boxes(const EdgeArrays& edges, double* boxes) {
    HWY_DYNAMIC_DISPATCH(FindBoxes)(edges, boxes);
}

bool contain(const BoxTree& tree, double x, double y) {
    return HWY_DYNAMIC_DISPATCH(ContainByTree)(tree, x, y);
}

NearEdge find_nearer(const BoxTree& tree, double x, double y, const NearEdge& guess) {
    return HWY_DYNAMIC_DISPATCH(FindNearer)(tree, x, y, guess);
}

std::uint32_t find_edges_within(const BoxTree& tree, double x, double y, double most,
                                std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesWithinByTree)(tree, x, y, most, found);
}

std::uint32_t find_edges_in(const BoxTree& tree, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesInByTree)(tree, box, found);
}

bool meets(const BoxTree& tree, const Extent& box) {
    return HWY_DYNAMIC_DISPATCH(Meets)(tree, box);
}

bool for_meeting_pairs(const BoxTree& first, const BoxTree& second, double margin,
                       const EdgePairSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForMeetingPairs)(first, second, margin, sink);
}

double for_closest(const BoxTree& first, const BoxTree& second, double most, double margin,
                   const VertexAndEdgeSink& sink) {
    return HWY_DYNAMIC_DISPATCH(ForClosest)(first, second, most, margin, sink);
}

}  // namespace nearfield::exact::kernels
#endif
