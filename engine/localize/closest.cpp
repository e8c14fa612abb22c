#include <engine/geometry/segment.hpp>
#include <engine/localize/closest.hpp>
#include <engine/localize/pair_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::localize {

using geometry::TransformedPolygon;
using geometry::Vector;

struct ClosestChains::Leaves {
    ClosestChains& search;

    [[nodiscard]] double squared_bound() const { return search.squared_bound_; }
    [[nodiscard]] static bool is_leaf(const LazyTree& tree, std::uint32_t node) {
        return !tree.splits(node);
    }

    void use(std::uint32_t a, std::uint32_t b, double squared) {
        tighten(search.tree_a_, a, search.tree_b_, b);
        tighten(search.tree_b_, b, search.tree_a_, a);
        search.pairs_.push_back({a, squared});
    }

    /// Tests the first edge of one leaf against every vertex of the other: true distances, at a
    /// cost linear in the edges rather than in their pairs.
    void tighten(const LazyTree& one, std::uint32_t i, const LazyTree& other, std::uint32_t j) {
        const TransformedPolygon& polygon = one.polygon();
        const Vector start = polygon.vertex(one[i].first);
        const Vector end = polygon.vertex(polygon.polygon().next(one[i].first));
        for (std::uint32_t v = other[j].first; v < other[j].first + other[j].count; ++v) {
            const double squared =
                geometry::nearest_on_segment(other.polygon().vertex(v), start, end)
                    .squared_distance;
            search.squared_bound_ = std::min(search.squared_bound_, squared);
        }
    }
};

Effort ClosestChains::find(const TransformedPolygon& a, const TransformedPolygon& b,
                           const OverlapOptions& options, std::vector<Chain>& chains) {
    tree_a_.plant(a, options.height, options.volume);
    tree_b_.plant(b, options.height, options.volume);
    squared_bound_ = std::numeric_limits<double>::infinity();
    pairs_.clear();
    Leaves leaves{*this};
    PairSearch search(tree_a_, tree_b_, leaves);
    search.run();

    // The bound, increased for the rounding of transformed vertices and of squares.
    const double rounding = placement_rounding(a, tree_a_[LazyTree::root].box) +
                            placement_rounding(b, tree_b_[LazyTree::root].box);
    const double limit = upper_bound() * (1.0 + 1e-12) + rounding;
    kept_.clear();
    for (const LeafPair& pair : pairs_) {
        if (pair.squared <= limit * limit) {
            kept_.push_back(pair.a);
        }
    }
    const auto by_first_edge = [this](std::uint32_t i, std::uint32_t j) {
        return tree_a_[i].first < tree_a_[j].first;
    };
    std::sort(kept_.begin(), kept_.end(), by_first_edge);
    kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
    for (const std::uint32_t leaf : kept_) {
        const Node& node = tree_a_[leaf];
        chains.push_back({node.ring, node.first, node.count, node.box});
    }
    return {tree_a_.nodes_evaluated() + tree_b_.nodes_evaluated(), search.pairs_rejected()};
}

double ClosestChains::upper_bound() const {
    return std::sqrt(squared_bound_);
}

}  // namespace nearfield::localize
