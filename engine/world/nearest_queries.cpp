#include <engine/world/nearest_hits.hpp>
#include <engine/world/nearest_queries.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::world {

void NearestQueries::begin(const Instances& instances, const NearestQuery& query,
                           const WorldFilter& filter) {
    instances_ = &instances;
    query_ = query;
    filter_ = filter;
    guess_ = BoxHierarchy::nowhere;
}

void NearestQueries::find_on(std::uint32_t index) {
    const simd::TransformedEdges& edges = instances_->edges(index);
    const simd::AabbTree& tree = instances_->tree(index);
    const bool inside =
        edges.box.contains(point_) && simd::kernels::contain(tree, point_.x(), point_.y());
    const double most = inside ? std::numeric_limits<double>::infinity()
                               : std::nextafter(nearest_.squared_reach(edges.rounding),
                                                std::numeric_limits<double>::infinity());
    const simd::NearEdge near =
        simd::kernels::find_nearer(tree, point_.x(), point_.y(), {UINT32_MAX, most});
    if (near.edge == UINT32_MAX) {
        return;
    }
    const geometry::NearestOnSegment on_edge =
        geometry::nearest_on_segment(point_, edges.start(near.edge), edges.end(near.edge));
    const double distance = std::sqrt(on_edge.squared_distance);
    if (distance > query_.max_distance) {
        return;
    }
    nearest_.offer(
        {{inside ? -distance : distance, instances_->number(index), index, near.edge}, on_edge});
}

void NearestQueries::find_edges_of(std::uint32_t index) {
    const simd::TransformedEdges& edges = instances_->edges(index);
    const auto use = [&](std::uint32_t edge) {
        const geometry::NearestOnSegment on_edge =
            geometry::nearest_on_segment(point_, edges.start(edge), edges.end(edge));
        nearest_.offer(
            {{std::sqrt(on_edge.squared_distance), instances_->number(index), index, edge},
             on_edge});
        return nearest_.squared_reach(edges.rounding);
    };
    simd::kernels::for_edges_near(instances_->tree(index), point_.x(), point_.y(),
                                  nearest_.squared_reach(edges.rounding), use);
}

void NearestQueries::find_in(std::uint32_t index) {
    if (query_.kind == NearestKind::instances) {
        find_on(index);
    } else {
        find_edges_of(index);
    }
}

void NearestQueries::find(const Vector2& point, std::span<NearestHit> hits) {
    point_ = geometry::to_vector(point);
    nearest_.begin(query_.count, query_.max_distance);
    const std::uint32_t guess = guess_;
    if (guess != BoxHierarchy::nowhere) {
        find_in(guess);
    }
    instances_->boxes().for_near(
        {point_, point_}, [this] { return nearest_.squared_reach(instances_->max_rounding()); },
        [&](std::uint32_t index, double) {
            if (index != guess && instances_->passes(index, filter_)) {
                find_in(index);
            }
        });
    const std::vector<Found>& nearest = nearest_.found();
    guess_ = nearest.empty() ? BoxHierarchy::nowhere : nearest.front().instance;
    std::fill(hits.begin(), hits.end(), NearestHit{});
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const Found& found = nearest[i];
        const simd::TransformedEdges& edges = instances_->edges(found.instance);
        hits[i] =
            hit_of({instances_->handle(found.instance), found.distance, found.edge, found.on_edge},
                   edges.placed, edges.rounding);
    }
}

}  // namespace nearfield::world
