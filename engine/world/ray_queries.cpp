#include <engine/geometry/segment.hpp>
#include <engine/world/ray_queries.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace nearfield::world {

using geometry::Vector;

namespace {

/// True if an edge joins two vertices at the same place. It has no normal, and the edges beside it
/// are hit wherever it would be.
bool is_repeated_vertex(const simd::TransformedEdges& edges, std::uint32_t edge) {
    // Far from the origin others, too, may have no length left; those are rare.
    if (edges.start(edge) != edges.end(edge)) {
        return false;
    }
    const geometry::Polygon& polygon = edges.placed.polygon();
    return polygon.vertices()[edge] == polygon.vertices()[polygon.next(edge)];
}

}  // namespace

void RayQueries::begin(const Instances& instances, const WorldFilter& filter) {
    instances_ = &instances;
    filter_ = filter;
}

void RayQueries::take(const Found& found) {
    if (all_ || found_.empty()) {
        found_.push_back(found);
    } else if (found < found_.front()) {
        found_.front() = found;
    }
}

void RayQueries::search_edges_of(std::uint32_t index) {
    const simd::TransformedEdges& edges = instances_->edges(index);
    struct Search {
        RayQueries& all;
        const simd::TransformedEdges& edges;
        std::uint32_t index;

        [[nodiscard]] double bound() const {
            return all.all_ || all.found_.empty() ? 1.0 : all.found_.front().parameter;
        }
    } search{*this, edges, index};
    const auto use = [](void* user, std::uint32_t edge) {
        const Search& of = *static_cast<Search*>(user);
        const std::optional<double> parameter =
            geometry::first_meeting(of.all.from_, of.all.to_, of.edges.start(edge),
                                    of.edges.end(edge), of.edges.rounding + of.all.rounding_);
        if (parameter && !is_repeated_vertex(of.edges, edge)) {
            of.all.take({*parameter, of.all.instances_->number(of.index), of.index, edge});
        }
        return of.bound();
    };
    simd::kernels::for_edges_along(instances_->tree(index), path_, edges.rounding + rounding_,
                                   search.bound(), {use, &search});
}

void RayQueries::search(const Segment& segment, bool all) {
    path_ = {segment.from.x, segment.from.y, segment.to.x, segment.to.y};
    from_ = geometry::to_vector(segment.from);
    to_ = geometry::to_vector(segment.to);
    // Of positions along the path.
    rounding_ = 4.0 * std::numeric_limits<double>::epsilon() *
                (from_.lpNorm<Eigen::Infinity>() + to_.lpNorm<Eigen::Infinity>());
    all_ = all;
    found_.clear();
    instances_->boxes().for_along(
        path_, 2.0 * (instances_->max_rounding() + rounding_),
        [this] { return all_ || found_.empty() ? 1.0 : found_.front().parameter; },
        [this](std::uint32_t index, double) {
            if (instances_->passes(index, filter_)) {
                search_edges_of(index);
            }
        });
}

RayHit RayQueries::hit_of(const Found& found) const {
    const simd::TransformedEdges& edges = instances_->edges(found.instance);
    const Vector way = to_ - from_;
    const Vector along = edges.end(found.edge) - edges.start(found.edge);
    // Far from the origin an edge may be shorter than what rounding leaves of it.
    const bool has_length = along != Vector::Zero();
    Vector normal = (has_length ? Vector(-along.y(), along.x()) : Vector(-way)).stableNormalized();
    if (normal.dot(way) > 0.0) {
        normal = -normal;
    }
    // What is as close as rounding allows is hit; the edge and the point are rounded once more.
    return {instances_->handle(found.instance),
            found.parameter,
            2.0 * (edges.rounding + rounding_) + instances_->deviation(found.instance),
            geometry::to_public(from_ + found.parameter * way),
            geometry::to_public(normal),
            found.edge};
}

RayHit RayQueries::first(const Segment& segment) {
    search(segment, false);
    return found_.empty() ? RayHit{} : hit_of(found_.front());
}

void RayQueries::find_all(const Segment& segment, std::vector<RayHit>& hits) {
    search(segment, true);
    std::sort(found_.begin(), found_.end());
    for (const Found& found : found_) {
        hits.push_back(hit_of(found));
    }
}

}  // namespace nearfield::world
