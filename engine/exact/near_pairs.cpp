#include <engine/exact/leaf.hpp>
#include <engine/exact/near_pairs.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/pair_search.hpp>

#include <cmath>
#include <limits>

namespace nearfield::exact {
namespace {

using localize::LazyTree;

/// Of two leaves, all within a distance.
struct WithinDistance {
    LazyTree& tree_a;
    LazyTree& tree_b;
    double squared_limit;
    std::size_t most;
    std::vector<VertexAndEdge>& found;

    [[nodiscard]] double squared_bound() const {
        return found.size() > most ? -1.0 : squared_limit;
    }
    [[nodiscard]] static bool is_leaf(const LazyTree& tree, std::uint32_t node) {
        return Leaf::is_leaf(tree[node]);
    }

    void add(const Leaf& vertices, const Leaf& edges, bool vertex_of_a) {
        for (std::uint32_t i = 0; i < vertices.count(); ++i) {
            // Where the last edge ends another one starts.
            const Edge from = vertices.edge(i);
            for (std::uint32_t j = 0; j < edges.count(); ++j) {
                const Edge edge = edges.edge(j);
                if (geometry::nearest_on_segment(from.start, edge.start, edge.end)
                        .squared_distance <= squared_limit) {
                    found.push_back({vertex_of_a, from.index, edge.index});
                }
            }
        }
    }

    void use(std::uint32_t node_a, std::uint32_t node_b, double /*squared*/) {
        const Leaf a(tree_a.polygon(), tree_a[node_a]);
        const Leaf b(tree_b.polygon(), tree_b[node_b]);
        add(a, b, true);
        add(b, a, false);
    }
};

}  // namespace

void NearPairFinder::begin(const PlacedEdges& a, const PlacedEdges& b) {
    a_ = &a;
    b_ = &b;
    by_trees_ = !is_small(a) || !is_small(b);
    if (by_trees_) {
        constexpr std::uint32_t no_limit = std::numeric_limits<std::uint32_t>::max();
        tree_a_.plant(a.placed, no_limit);
        tree_b_.plant(b.placed, no_limit);
    }
}

bool NearPairFinder::add_near_edges(const PlacedEdges& vertices, const PlacedEdges& edges,
                                    bool vertex_of_a, double squared, std::size_t most) {
    const std::uint32_t count = kernels::find_points_within(vertices.starts(), extent_of(edges.box),
                                                            squared, vertices_.data());
    for (std::uint32_t i = 0; i < count && found_.size() <= most; ++i) {
        const std::uint32_t vertex = vertices_[i];
        const std::uint32_t near = kernels::find_edges_within(
            edges, vertices.start_x[vertex], vertices.start_y[vertex], squared, edges_.data());
        for (std::uint32_t k = 0; k < near; ++k) {
            found_.push_back({vertex_of_a, vertex, edges_[k]});
        }
    }
    return found_.size() <= most;
}

bool NearPairFinder::find(double distance, std::size_t most) {
    // More than what the kernels, the boxes or placing the vertices may have rounded.
    const double limit = distance * (1.0 + 1e-12) + a_->rounding + b_->rounding;
    found_.clear();
    if (by_trees_) {
        WithinDistance within{tree_a_, tree_b_, limit * limit, most, found_};
        localize::PairSearch(tree_a_, tree_b_, within).run();
        return found_.size() <= most;
    }
    return add_near_edges(*a_, *b_, true, limit * limit, most) &&
           add_near_edges(*b_, *a_, false, limit * limit, most);
}

}  // namespace nearfield::exact
