#include <engine/exact/closest_pair.hpp>
#include <engine/exact/leaf.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/pair_search.hpp>

#include <cmath>

namespace nearfield::exact {
namespace {

using geometry::PlacedPolygon;
using geometry::Vector;
using localize::LazyTree;

/// Calls `use(edge of A, its ends, edge of B, its ends)` for all edges of two leaves.
template <class Use>
void for_each_pair(const LazyTree& tree_a, std::uint32_t node_a, const LazyTree& tree_b,
                   std::uint32_t node_b, const Use& use) {
    const Leaf a(tree_a.polygon(), tree_a[node_a]);
    const Leaf b(tree_b.polygon(), tree_b[node_b]);
    for (std::uint32_t i = 0; i < a.count(); ++i) {
        for (std::uint32_t j = 0; j < b.count(); ++j) {
            use(a.edge(i), b.edge(j));
        }
    }
}

struct Nearer {
    LazyTree& tree_a;
    LazyTree& tree_b;
    ClosestPair best;
    double bound;

    // Nothing is closer than a common point.
    [[nodiscard]] double squared_bound() const {
        return best.squared_distance == 0.0 ? -1.0 : bound;
    }
    [[nodiscard]] static bool is_leaf(const LazyTree& tree, std::uint32_t node) {
        return Leaf::is_leaf(tree[node]);
    }

    void use(std::uint32_t node_a, std::uint32_t node_b, double) {
        for_each_pair(tree_a, node_a, tree_b, node_b, [this](const Edge& a, const Edge& b) {
            const auto closest = geometry::closest_of_segments(a.start, a.end, b.start, b.end);
            if (closest.squared_distance < best.squared_distance) {
                best = {a.index,
                        b.index,
                        closest.first,
                        closest.second,
                        closest.first_parameter,
                        closest.second_parameter,
                        closest.squared_distance};
                bound = std::min(bound, best.squared_distance);
            }
        });
    }
};

/// Looks for an end of an edge that is close to the other boundary and not near the closest pair.
/// Where more than one pair is closest, an end is among them: the distance of two straight edges
/// is least at an end of one of them, and where that is not the only place they run in parallel.
struct Rival {
    LazyTree& tree_a;
    LazyTree& tree_b;
    const ClosestPair& closest;
    Side side;
    double squared_limit;
    double squared_apart;
    bool found = false;

    [[nodiscard]] double squared_bound() const { return found ? -1.0 : squared_limit; }
    [[nodiscard]] static bool is_leaf(const LazyTree& tree, std::uint32_t node) {
        return Leaf::is_leaf(tree[node]);
    }

    void consider(const Vector& on_a, const Vector& on_b, double squared) {
        const bool elsewhere =
            (on_a - closest.point_a).squaredNorm() > squared_apart ||
            (side == Side::either && (on_b - closest.point_b).squaredNorm() > squared_apart);
        found = found || (squared <= squared_limit && elsewhere);
    }

    void use(std::uint32_t node_a, std::uint32_t node_b, double) {
        for_each_pair(tree_a, node_a, tree_b, node_b, [this](const Edge& a, const Edge& b) {
            for (const Vector& end : {a.start, a.end}) {
                const auto nearest = geometry::nearest_on_segment(end, b.start, b.end);
                consider(end, nearest.point, nearest.squared_distance);
            }
            for (const Vector& end : {b.start, b.end}) {
                const auto nearest = geometry::nearest_on_segment(end, a.start, a.end);
                consider(nearest.point, end, nearest.squared_distance);
            }
        });
    }
};

}  // namespace

ClosestPair ClosestPairFinder::find(const PlacedPolygon& a, const PlacedPolygon& b,
                                    double at_most) {
    constexpr std::uint32_t no_limit = std::numeric_limits<std::uint32_t>::max();
    tree_a_.plant(a, no_limit);
    tree_b_.plant(b, no_limit);
    // A little more than what is known, so that the pair it is known from is found again.
    const double bound = at_most * (1.0 + 1e-12);
    Nearer nearer{tree_a_, tree_b_, {}, bound * bound};
    localize::PairSearch(tree_a_, tree_b_, nearer).run();
    return nearer.best;
}

bool ClosestPairFinder::is_unique(const ClosestPair& closest, Side side, double margin,
                                  double apart) {
    const double limit = std::sqrt(closest.squared_distance) + margin;
    Rival rival{tree_a_, tree_b_, closest, side, limit * limit, apart * apart};
    localize::PairSearch(tree_a_, tree_b_, rival).run();
    return !rival.found;
}

}  // namespace nearfield::exact
