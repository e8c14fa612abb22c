#include <engine/base/interruption.hpp>
#include <engine/simd/nearest_kernels.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/nearest_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/disc_of_points-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// The number of consecutive points processed together, for any instruction set.
constexpr std::uint32_t max_together = max_lanes;

/// Writes the results for the points at `i` of the arrays from their nearest edges, as
/// geometry::nearest_on_segment() computes them.
HWY_INLINE void write_points(const EdgeArrays& edges, Lanes nearest_edge, Lanes x, Lanes y,
                             std::size_t i, const NearestArrays& nearest) {
    const Tag tag;
    const auto edge = hn::ConvertTo(hn::RebindToSigned<Tag>(), nearest_edge);
    EdgeLanes ends;
    ends.start_x = hn::GatherIndex(tag, edges.start_x, edge);
    ends.start_y = hn::GatherIndex(tag, edges.start_y, edge);
    ends.end_x = hn::GatherIndex(tag, edges.end_x, edge);
    ends.end_y = hn::GatherIndex(tag, edges.end_y, edge);
    const NearestLanes found = nearest_on_edges(ends, x, y);
    hn::StoreU(found.x, tag, nearest.x + i);
    hn::StoreU(found.y, tag, nearest.y + i);
    hn::StoreU(hn::Sqrt(found.squared), tag, nearest.distance + i);
    hn::StoreU(found.parameter, tag, nearest.parameter + i);
}

/// Nearest edges of several points at once, one edge after the other.
class NearestOfLanes {
public:
    HWY_INLINE NearestOfLanes()
        : first_(hn::Set(Tag(), std::numeric_limits<double>::infinity())),
          second_(first_),
          third_(first_),
          first_edge_(hn::Zero(Tag())),
          second_edge_(hn::Zero(Tag())) {}

    HWY_INLINE void Look(Lanes squared, Lanes edge) {
        const LaneMask nearest = hn::Lt(squared, first_);
        const LaneMask second = hn::Lt(squared, second_);
        third_ = hn::Min(third_, hn::Max(second_, squared));
        second_ = hn::Min(second_, hn::Max(first_, squared));
        first_ = hn::Min(first_, squared);
        second_edge_ =
            hn::IfThenElse(nearest, first_edge_, hn::IfThenElse(second, edge, second_edge_));
        first_edge_ = hn::IfThenElse(nearest, edge, first_edge_);
    }

    /// Writes the results for the points at `i` of the arrays.
    HWY_INLINE void Write(const EdgeArrays& edges, Lanes x, Lanes y, std::size_t i,
                          const NearestArrays& nearest) const {
        const Tag tag;
        const hn::Rebind<std::int32_t, Tag> half;
        const hn::Rebind<std::uint32_t, Tag> index;
        hn::StoreU(hn::BitCast(index, hn::DemoteTo(half, first_edge_)), index, nearest.edge + i);
        hn::StoreU(hn::BitCast(index, hn::DemoteTo(half, second_edge_)), index, nearest.second + i);
        hn::StoreU(second_, tag, nearest.second_squared + i);
        hn::StoreU(third_, tag, nearest.third_squared + i);
        write_points(edges, first_edge_, x, y, i, nearest);
    }

private:
    Lanes first_;
    Lanes second_;
    Lanes third_;
    Lanes first_edge_;
    Lanes second_edge_;
};

/// One edge in every lane, including its length.
HWY_INLINE EdgesAlong same_along(const EdgeArrays& edges, std::size_t edge) {
    const Tag tag;
    const double x = edges.end_x[edge] - edges.start_x[edge];
    const double y = edges.end_y[edge] - edges.start_y[edge];
    EdgesAlong same;
    same.start_x = hn::Set(tag, edges.start_x[edge]);
    same.start_y = hn::Set(tag, edges.start_y[edge]);
    same.along_x = hn::Set(tag, x);
    same.along_y = hn::Set(tag, y);
    same.inverse_length = hn::Set(tag, 1.0 / (x * x + y * y));
    return same;
}

/// Finds the nearest of the listed edges for some points.
HWY_INLINE void solve(const PointArrays& points, std::uint32_t first, std::uint32_t together,
                      const EdgeArrays& edges, const std::uint32_t* listed, std::uint32_t count,
                      const NearestArrays& nearest) {
    const Tag tag;
    for (std::uint32_t i = first; i < first + together;
         i += static_cast<std::uint32_t>(hn::Lanes(tag))) {
        const Lanes x = hn::LoadU(tag, points.x + i);
        const Lanes y = hn::LoadU(tag, points.y + i);
        NearestOfLanes search;
        for (std::uint32_t k = 0; k < count; ++k) {
            search.Look(squared_distances(same_along(edges, listed[k]), x, y),
                        hn::Set(tag, static_cast<double>(listed[k])));
        }
        search.Write(edges, x, y, i, nearest);
    }
}

void FindNearestOf(const PointArrays& points, const EdgeArrays& edges, double margin,
                   std::uint32_t* near, const NearestArrays& nearest) {
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t i = 0; i < points.count; i += max_together) {
        checkpoint.step();
        const std::uint32_t together = std::min(points.count - i, max_together);
        const DiscOfPoints disc = disc_around(points, i, together);
        const double least = LeastSquared(edges, disc.x, disc.y);
        const std::uint32_t count =
            FindEdgesWithin(edges, disc.x, disc.y, squared_reach(disc, least, margin), near);
        solve(points, i, together, edges, near, count, nearest);
    }
}

/// The edges at `listed` and the following entries, including their lengths.
HWY_INLINE EdgesAlong gather_along(const EdgeArrays& edges, const std::uint32_t* listed) {
    const Tag tag;
    const hn::Rebind<std::uint32_t, Tag> half;
    const hn::RebindToSigned<Tag> whole;
    const auto edge =
        hn::BitCast(whole, hn::PromoteTo(hn::RebindToUnsigned<Tag>(), hn::LoadU(half, listed)));
    EdgesAlong along;
    along.start_x = hn::GatherIndex(tag, edges.start_x, edge);
    along.start_y = hn::GatherIndex(tag, edges.start_y, edge);
    along.along_x = hn::Sub(hn::GatherIndex(tag, edges.end_x, edge), along.start_x);
    along.along_y = hn::Sub(hn::GatherIndex(tag, edges.end_y, edge), along.start_y);
    const Lanes squared =
        hn::Add(hn::Mul(along.along_x, along.along_x), hn::Mul(along.along_y, along.along_y));
    along.inverse_length = hn::Div(hn::Set(tag, 1.0), squared);
    return along;
}

/// If no more edges are near a group of points, none of them is worth excluding.
constexpr std::uint32_t few_edges = 32;

/// The nearest edges of points among edges that boxes do not tell apart: halves the points again
/// and again, each half with those of the edges that can be nearest to one of its points.
class NearestByDivision {
public:
    HWY_INLINE NearestByDivision(const PointArrays& points, const EdgeArrays& edges, double margin,
                                 DivisionMemory& memory, const NearestArrays& nearest)
        : points_(points), edges_(edges), margin_(margin), memory_(memory), nearest_(nearest) {}

    /// `chosen`: indices of points; their order changes.
    void Solve(std::uint32_t* chosen, std::uint32_t count) {
        std::uint32_t* const all = memory_.list(1, edges_.count);
        for (std::uint32_t i = 0; i < edges_.count; ++i) {
            all[i] = i;
        }
        squared_ = memory_.numbers(0, edges_.count);
        Divide(chosen, count, all, edges_.count, 2);
    }

private:
    /// `listed`: in ascending order, all edges that can be nearest to one of the points.
    void Divide(std::uint32_t* chosen, std::uint32_t count, std::uint32_t* listed,
                std::uint32_t edges, std::uint32_t depth) {
        checkpoint_.step();
        if (count <= max_together || edges <= few_edges) {
            for (std::uint32_t i = 0; i < count; i += max_together) {
                SolveGroup(chosen + i, std::min(count - i, max_together), listed, edges);
            }
            return;
        }
        const Extent box = extent_of_points(points_.x, points_.y, chosen, count);
        std::uint32_t* const left = memory_.list(depth, edges);
        const std::uint32_t left_count = Narrow(disc_around(box), listed, edges, left);
        const std::uint32_t half = halve(points_.x, points_.y, box, chosen, count);
        Divide(chosen, half, left, left_count, depth + 1);
        Divide(chosen + half, count - half, left, left_count, depth + 1);
    }

    /// Copies the edges that can be nearest to a point of a disc; returns their number.
    HWY_INLINE std::uint32_t Narrow(const DiscOfPoints& disc, std::uint32_t* listed,
                                    std::uint32_t edges, std::uint32_t* left) {
        const Tag tag;
        const auto step = static_cast<std::uint32_t>(hn::Lanes(tag));
        std::fill(listed + edges, listed + edges + max_lanes, listed[edges - 1]);
        const Lanes x = hn::Set(tag, disc.x);
        const Lanes y = hn::Set(tag, disc.y);
        Lanes least = hn::Set(tag, std::numeric_limits<double>::infinity());
        for (std::uint32_t i = 0; i < edges; i += step) {
            const Lanes squared = squared_distances(gather_along(edges_, listed + i), x, y);
            hn::StoreU(squared, tag, squared_ + i);
            least = hn::Min(least, squared);
        }
        const double reach = squared_reach(disc, min_lane(least), margin_);
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < edges; ++i) {
            left[count] = listed[i];
            count += squared_[i] <= reach ? 1U : 0U;
        }
        return count;
    }

    void SolveGroup(const std::uint32_t* chosen, std::uint32_t count, const std::uint32_t* listed,
                    std::uint32_t edges) {
        double x[max_together];
        double y[max_together];
        for (std::uint32_t i = 0; i < max_together; ++i) {
            x[i] = points_.x[chosen[std::min(i, count - 1)]];
            y[i] = points_.y[chosen[std::min(i, count - 1)]];
        }
        double numbers[6][max_together];
        std::uint32_t indices[2][max_together];
        const NearestArrays found{numbers[0], numbers[1], numbers[2], numbers[3],
                                  numbers[4], numbers[5], indices[0], indices[1]};
        solve({max_together, x, y}, 0, max_together, edges_, listed, edges, found);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t at = chosen[i];
            nearest_.x[at] = found.x[i];
            nearest_.y[at] = found.y[i];
            nearest_.distance[at] = found.distance[i];
            nearest_.parameter[at] = found.parameter[i];
            nearest_.second_squared[at] = found.second_squared[i];
            nearest_.third_squared[at] = found.third_squared[i];
            nearest_.edge[at] = found.edge[i];
            nearest_.second[at] = found.second[i];
        }
    }

    const PointArrays& points_;
    const EdgeArrays& edges_;
    double margin_;
    DivisionMemory& memory_;
    const NearestArrays& nearest_;
    double* squared_ = nullptr;  // scratch: distances of listed edges
    SparseCheckpoint<16> checkpoint_;
};

/// Finds the nearest edges of points, in groups where few edges can be nearest to any of them.
class NearestByTree {
public:
    HWY_INLINE NearestByTree(const PointArrays& points, const AabbTree& tree, double margin,
                             std::uint32_t* near, std::uint32_t* crowded,
                             const NearestArrays& nearest)
        : points_(points),
          tree_(tree),
          margin_(margin),
          near_(near),
          crowded_(crowded),
          nearest_(nearest),
          most_visits_(std::max(few_visits, 2 * tree.edges().count / groups_of(points.count))),
          last_(tree.edges_of(0).first) {}

    /// For consecutive points, or lists them as crowded.
    void Solve(std::uint32_t first, std::uint32_t together) {
        if (trials_.skip()) {
            SetAside(first, together);
            return;
        }
        VisitsLeft left{most_visits_};
        Solve(first, together, left);
        trials_.record(left.count == 0);
    }

    /// The number of points that are crowded: among so many boxes that the tree does not help.
    [[nodiscard]] std::uint32_t crowded_count() const { return crowded_count_; }

private:
    // Several times what a tree takes that divides the edges well.
    static constexpr std::uint32_t few_visits = 128;

    [[nodiscard]] static std::uint32_t groups_of(std::uint32_t points) {
        return points / max_together + 1;
    }
    void SetAside(std::uint32_t first, std::uint32_t together) {
        for (std::uint32_t i = first; i < first + together; ++i) {
            crowded_[crowded_count_++] = i;
        }
    }

    void Solve(std::uint32_t first, std::uint32_t together, VisitsLeft& left) {
        const DiscOfPoints disc = disc_around(points_, first, together);
        const NearEdge guess{last_, LengthTo(disc, last_)};
        const NearEdge closest = FindNearer(tree_, disc.x, disc.y, guess, left);
        last_ = closest.edge;
        const std::uint32_t count = FindEdgesWithinByTree(
            tree_, disc.x, disc.y, squared_reach(disc, closest.squared, margin_),
            together > 1 ? few_edges : tree_.edges().count, left, near_);
        if (left.count == 0) {
            SetAside(first, together);
        } else if (count <= few_edges || together == 1) {
            solve(points_, first, together, tree_.edges(), near_, count, nearest_);
        } else {
            const std::uint32_t half = together / 2;
            Solve(first, half, left);
            Solve(first + half, together - half, left);
        }
    }

    [[nodiscard]] double LengthTo(const DiscOfPoints& disc, std::uint32_t edge) const {
        const Tag tag;
        return hn::GetLane(squared_distances(same_along(tree_.edges(), edge), hn::Set(tag, disc.x),
                                             hn::Set(tag, disc.y)));
    }

    const PointArrays& points_;
    const AabbTree& tree_;
    double margin_;
    std::uint32_t* near_;
    std::uint32_t* crowded_;
    std::uint32_t crowded_count_ = 0;
    SearchTrials trials_;  // of groups
    const NearestArrays& nearest_;
    // Of a group. It may take about as long as its share of a division of all edges: for few points
    // the tree is quicker even if it does not help much.
    std::uint32_t most_visits_;
    std::uint32_t last_;  // the edge nearest to the previous points
};

void FindNearestOfByTree(const PointArrays& points, const AabbTree& tree, double margin,
                         std::uint32_t* near, DivisionMemory& memory,
                         const NearestArrays& nearest) {
    std::uint32_t* const crowded = memory.list(0, points.count);
    NearestByTree search(points, tree, margin, near, crowded, nearest);
    SparseCheckpoint<16> checkpoint;
    for (std::uint32_t i = 0; i < points.count; i += max_together) {
        checkpoint.step();
        search.Solve(i, std::min(points.count - i, max_together));
    }
    if (search.crowded_count() > 0) {
        NearestByDivision(points, tree.all_edges(), margin, memory, nearest)
            .Solve(crowded, search.crowded_count());
    }
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindNearestOf);
HWY_EXPORT(FindNearestOfByTree);

void find_nearest_of(const PointArrays& points, const EdgeArrays& edges, double margin,
                     std::uint32_t* near, const NearestArrays& nearest) {
    HWY_DYNAMIC_DISPATCH(FindNearestOf)(points, edges, margin, near, nearest);
}

void find_nearest_of(const PointArrays& points, const AabbTree& tree, double margin,
                     std::uint32_t* near, DivisionMemory& memory, const NearestArrays& nearest) {
    HWY_DYNAMIC_DISPATCH(FindNearestOfByTree)(points, tree, margin, near, memory, nearest);
}

}  // namespace nearfield::simd::kernels
#endif
