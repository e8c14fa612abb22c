#include <engine/geometry/segment.hpp>
#include <engine/raster/closest_chains.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nearfield::raster {

using geometry::Node;
using geometry::TransformedPolygon;
using geometry::Vector;

void LazyTree::plant(const TransformedPolygon& polygon, const geometry::OverlapOptions& options) {
    hierarchy_.emplace(polygon, options.height, options.volume);
    nodes_.assign(1, hierarchy_->root());
    halves_.assign(1, unknown);
}

std::uint32_t LazyTree::first_half(std::uint32_t index) {
    if (halves_[index] == unknown) {
        halves_[index] = static_cast<std::uint32_t>(nodes_.size());
        const std::array<Node, 2> halves = hierarchy_->halves(nodes_[index]);
        nodes_.insert(nodes_.end(), halves.begin(), halves.end());
        halves_.insert(halves_.end(), 2, unknown);
    }
    return halves_[index];
}

geometry::Effort ClosestChains::find(const TransformedPolygon& a, const TransformedPolygon& b,
                                     const geometry::OverlapOptions& options,
                                     std::vector<geometry::Chain>& chains) {
    constexpr std::uint32_t root = LazyTree::root;
    tree_a_.plant(a, options);
    tree_b_.plant(b, options);
    volume_ = options.volume;
    squared_bound_ = std::numeric_limits<double>::infinity();
    pairs_rejected_ = 0;
    pairs_.clear();
    visit(root, root, squared_distance(root, root));

    // The bound, increased for the rounding of transformed vertices and of squares.
    const double rounding = geometry::placement_rounding(a, tree_a_[root].box) +
                            geometry::placement_rounding(b, tree_b_[root].box);
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
    return {tree_a_.nodes_evaluated() + tree_b_.nodes_evaluated(), pairs_rejected_};
}

double ClosestChains::upper_bound() const {
    return std::sqrt(squared_bound_);
}

void ClosestChains::visit(std::uint32_t a, std::uint32_t b, double squared) {
    checkpoint_.step();
    if (squared > squared_bound_) {
        ++pairs_rejected_;
        return;
    }
    const bool splits_a = tree_a_.splits(a);
    const bool splits_b = tree_b_.splits(b);
    if (!splits_a && !splits_b) {
        tighten(tree_a_, a, tree_b_, b);
        tighten(tree_b_, b, tree_a_, a);
        pairs_.push_back({a, squared});
        return;
    }
    // Split the larger node first: both shrink together.
    if (!splits_b || (splits_a && tree_a_[a].count >= tree_b_[b].count)) {
        const std::uint32_t half = tree_a_.first_half(a);
        visit_nearer_first(half, b, half + 1, b);
    } else {
        const std::uint32_t half = tree_b_.first_half(b);
        visit_nearer_first(a, half, a, half + 1);
    }
}

void ClosestChains::visit_nearer_first(std::uint32_t a1, std::uint32_t b1, std::uint32_t a2,
                                       std::uint32_t b2) {
    const double first = squared_distance(a1, b1);
    const double second = squared_distance(a2, b2);
    if (first <= second) {
        visit(a1, b1, first);
        visit(a2, b2, second);
    } else {
        visit(a2, b2, second);
        visit(a1, b1, first);
    }
}

/// Tests the first edge of one leaf against every vertex of the other: true distances, at a cost
/// linear in the edges rather than in their pairs.
void ClosestChains::tighten(const LazyTree& one, std::uint32_t i, const LazyTree& other,
                            std::uint32_t j) {
    const TransformedPolygon& polygon = one.polygon();
    const Vector start = polygon.vertex(one[i].first);
    const Vector end = polygon.vertex(polygon.polygon().next(one[i].first));
    for (std::uint32_t v = other[j].first; v < other[j].first + other[j].count; ++v) {
        const double squared =
            geometry::nearest_on_segment(other.polygon().vertex(v), start, end).squared_distance;
        squared_bound_ = std::min(squared_bound_, squared);
    }
}

}  // namespace nearfield::raster
