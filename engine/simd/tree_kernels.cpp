#include <engine/base/interruption.hpp>
#include <engine/simd/aabb_tree.hpp>

#include <algorithm>
#include <bit>
#include <limits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/tree_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/box_lanes-inl.hpp>
#include <engine/simd/oriented_lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

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
        box[0] = min_lane(low_x);
        box[length] = min_lane(low_y);
        box[2 * length] = max_lane(high_x);
        box[3 * length] = max_lane(high_y);
    }
}

void FindPieceBoxes(const EdgeArrays& edges, std::span<const EdgeRange> pieces, double* boxes,
                    std::size_t length) {
    for (const EdgeRange& piece : pieces) {
        Extent box = extent_of(edges, piece.first, 0.0);
        for (std::uint32_t i = piece.first + 1; i < piece.end; ++i) {
            // Its start is the end of the one before.
            box = {std::min(box.low_x, edges.end_x[i]), std::min(box.low_y, edges.end_y[i]),
                   std::max(box.high_x, edges.end_x[i]), std::max(box.high_y, edges.end_y[i])};
        }
        boxes[0] = box.low_x;
        boxes[length] = box.low_y;
        boxes[2 * length] = box.high_x;
        boxes[3 * length] = box.high_y;
        ++boxes;
    }
}

/// Builds boxes over eight boxes each; `length` is the distance between the arrays of the sides.
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
        box[0] = min_lane(all.low_x);
        box[length] = min_lane(all.low_y);
        box[2 * length] = max_lane(all.high_x);
        box[3 * length] = max_lane(all.high_y);
    }
}

void FindBoxes(const EdgeArrays& edges, std::span<const EdgeRange> pieces, double* boxes) {
    const AabbTree tree(edges, pieces, boxes);
    boxes += 2 * padded(tree.count(0));
    for (std::uint32_t level = 0; level <= tree.top_level(); ++level) {
        const std::uint32_t count = tree.count(level);
        const std::size_t length = padded(count);
        if (level == 0 && tree.is_in_order()) {
            FindEdgeBoxes(edges, boxes, length);
        } else if (level == 0) {
            FindPieceBoxes(edges, pieces, boxes, length);
        } else {
            FindBoxesOver(tree.boxes(level - 1, 0), boxes, length);
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

/// Sorts a list of edges into array order.
HWY_INLINE std::uint32_t in_order(const AabbTree& tree, std::uint32_t* found, std::uint32_t count) {
    if (!tree.is_in_order()) {
        std::sort(found, found + count);
    }
    return count;
}

/// How far the boxes of a tree are from a point, at least.
class DistancesFrom {
public:
    HWY_INLINE DistancesFrom(const AabbTree& tree, double x, double y)
        : tree_(tree),
          point_(lanes_of({x, y, x, y})),
          local_(
              tree.on_demand() != nullptr ? tree.on_demand()->placement() : geometry::Placement{},
              x, y),
          allowance_(
              hn::Set(Tag(), tree.on_demand() != nullptr ? tree.on_demand()->allowance() : 0.0)) {}

    /// Writes the squares for eight boxes.
    HWY_INLINE void Square(std::uint32_t level, std::uint32_t first, double* squared) const {
        const EdgesOnDemand* const own = tree_.on_demand();
        if (own == nullptr) {
            const BoxArrays& boxes = tree_.boxes(level, first);
            for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
                hn::StoreU(squared_between(boxes_at(boxes, first + i), point_), Tag(), squared + i);
            }
            return;
        }
        const geometry::EdgeBoxes::Group& group = own->group(level, first / fan_out);
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(Tag())) {
            hn::StoreU(squared_from(group, i, local_, allowance_), Tag(), squared + i);
        }
    }

private:
    const AabbTree& tree_;
    LanesOfExtent point_;
    LocalPoint local_;
    Lanes allowance_;
};

std::uint32_t FindEdgesWithinByTree(const AabbTree& tree, double point_x, double point_y,
                                    double most, std::uint32_t enough, VisitsLeft& left,
                                    std::uint32_t* found) {
    const Tag tag;
    const DistancesFrom distances(tree, point_x, point_y);
    const Lanes x = hn::Set(tag, point_x);
    const Lanes y = hn::Set(tag, point_y);
    const Lanes limit = hn::Set(tag, most);
    std::uint32_t count = 0;
    for_leaves_opened(
        tree,
        [&](std::uint32_t level, std::uint32_t first) HWY_ATTR {
            if (left.count == 0) {
                return 0U;
            }
            --left.count;
            double squared[fan_out];
            distances.Square(level, first, squared);
            return bits_of_eight(
                [&](std::size_t i) HWY_ATTR { return hn::Le(hn::LoadU(tag, squared + i), limit); });
        },
        [&](std::uint32_t box) HWY_ATTR {
            const EdgeRange edges = tree.edges_of(box);
            for (std::size_t i = edges.first; i < edges.end; i += hn::Lanes(tag)) {
                const Lanes squared = squared_distances(edges_along(tree.edges(), i), x, y);
                count = append_lanes(hn::Le(squared, limit), i, edges.end, found, count);
            }
            return count <= enough && left.count > 0;
        });
    return in_order(tree, found, count);
}

/// Appends the edges of a lowest box whose own boxes intersect a box.
HWY_INLINE std::uint32_t append_edges_in(const AabbTree& tree, std::uint32_t box,
                                         const LanesOfExtent& bounds, std::uint32_t* found,
                                         std::uint32_t count) {
    const EdgeRange edges = tree.edges_of(box);
    for (std::size_t i = edges.first; i < edges.end; i += hn::Lanes(Tag())) {
        count = append_lanes(meet(bounds, EdgeLanes(tree.edges(), i)), i, edges.end, found, count);
    }
    return count;
}

std::uint32_t FindEdgesInByTree(const AabbTree& tree, const Extent& box, std::uint32_t* found) {
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    for_leaves(
        tree, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, bounds); },
        [&](std::uint32_t of_edges) HWY_ATTR {
            count = append_edges_in(tree, of_edges, bounds, found, count);
            return true;
        });
    return in_order(tree, found, count);
}

bool Meets(const AabbTree& tree, const Extent& box) {
    const LanesOfExtent bounds = lanes_of(box);
    bool found = false;
    for_leaves(
        tree, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, bounds); },
        [&](std::uint32_t of_edges) HWY_ATTR {
            const EdgeRange edges = tree.edges_of(of_edges);
            const std::uint32_t bits = bits_of_eight([&](std::size_t i) HWY_ATTR {
                return meet(bounds, EdgeLanes(tree.edges(), edges.first + i));
            });
            found = (bits & bits_of_range(edges)) != 0;
            return !found;
        });
    return found;
}

std::uint32_t FindEdgesNear(const AabbTree& tree, const Extent& box, const AabbTree& others,
                            double reach, std::uint32_t* found) {
    const LanesOfExtent bounds = lanes_of(box);
    std::uint32_t count = 0;
    SparseCheckpoint<256> checkpoint;
    for_leaves(
        tree, [&](const LanesOfExtent& boxes) HWY_ATTR { return meet(boxes, bounds); },
        [&](std::uint32_t of_edges) HWY_ATTR {
            checkpoint.step();
            if (Meets(others, grown(tree.box(0, of_edges), reach))) {
                count = append_edges_in(tree, of_edges, bounds, found, count);
            }
            return true;
        });
    return in_order(tree, found, count);
}

/// Finds the edge nearest to a point, visiting the nearest box first.
class NearestSearch {
public:
    HWY_INLINE NearestSearch(const AabbTree& tree, double x, double y, const NearEdge& guess,
                             VisitsLeft& left)
        : tree_(tree),
          distances_(tree, x, y),
          point_x_(x),
          point_y_(y),
          best_(guess),
          left_(left) {}

    void Visit(std::uint32_t level, std::uint32_t first) {
        if (left_.count == 0) {
            return;
        }
        --left_.count;
        const Tag tag;
        double squared[fan_out];
        distances_.Square(level, first, squared);
        std::uint32_t bits = 0;
        Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < fan_out; i += hn::Lanes(tag)) {
            const Lanes distances = hn::LoadU(tag, squared + i);
            bits |= bits_of(hn::Lt(distances, hn::Set(tag, best_.squared))) << i;
            least = hn::Min(least, distances);
        }
        if (bits == 0) {
            return;
        }
        if ((bits & (bits - 1)) != 0) {
            // Nearest first: hardly any other box is left after it.
            const double nearest = min_lane(least);
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
        const Lanes x = hn::Set(tag, point_x_);
        const Lanes y = hn::Set(tag, point_y_);
        const EdgeRange range = tree_.edges_of(box);
        for (std::size_t i = range.first; i < range.end; i += hn::Lanes(tag)) {
            // The other lanes may hold edges that are as near.
            const Lanes squared = hn::IfThenElse(
                hn::FirstN(tag, range.end - i), squared_distances(edges_along(edges, i), x, y),
                hn::Set(tag, std::numeric_limits<double>::infinity()));
            if (!hn::AllFalse(tag, hn::Lt(squared, hn::Set(tag, best_.squared)))) {
                best_ = min_of(squared, hn::Iota(tag, static_cast<double>(i)));
            }
        }
    }

    const AabbTree& tree_;
    DistancesFrom distances_;
    double point_x_;
    double point_y_;
    NearEdge best_;
    VisitsLeft& left_;
};

NearEdge FindNearer(const AabbTree& tree, double x, double y, const NearEdge& guess,
                    VisitsLeft& left) {
    NearestSearch search(tree, x, y, guess, left);
    search.Visit(tree.top_level(), 0);
    return search.best();
}

NearEdge FindNearestEdge(const AabbTree& tree, double x, double y, const NearEdge& guess) {
    VisitsLeft unlimited;
    return FindNearer(tree, x, y, guess, unlimited);
}

std::uint32_t FindAllEdgesWithin(const AabbTree& tree, double x, double y, double most,
                                 std::uint32_t* found) {
    VisitsLeft unlimited;
    return FindEdgesWithinByTree(tree, x, y, most, tree.edges().count, unlimited, found);
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindBoxes);
HWY_EXPORT(FindNearestEdge);
HWY_EXPORT(FindAllEdgesWithin);
HWY_EXPORT(FindEdgesInByTree);
HWY_EXPORT(FindEdgesNear);
HWY_EXPORT(Meets);

void find_boxes(const EdgeArrays& edges, std::span<const EdgeRange> pieces, double* boxes) {
    HWY_DYNAMIC_DISPATCH(FindBoxes)(edges, pieces, boxes);
}

NearEdge find_nearer(const AabbTree& tree, double x, double y, const NearEdge& guess) {
    return HWY_DYNAMIC_DISPATCH(FindNearestEdge)(tree, x, y, guess);
}

std::uint32_t find_edges_within(const AabbTree& tree, double x, double y, double most,
                                std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindAllEdgesWithin)(tree, x, y, most, found);
}

std::uint32_t find_edges_in(const AabbTree& tree, const Extent& box, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesInByTree)(tree, box, found);
}

std::uint32_t find_edges_near(const AabbTree& tree, const Extent& box, const AabbTree& others,
                              double reach, std::uint32_t* found) {
    return HWY_DYNAMIC_DISPATCH(FindEdgesNear)(tree, box, others, reach, found);
}

bool meets(const AabbTree& tree, const Extent& box) {
    return HWY_DYNAMIC_DISPATCH(Meets)(tree, box);
}

}  // namespace nearfield::simd::kernels
#endif
