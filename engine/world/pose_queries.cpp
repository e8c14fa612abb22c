#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/simd/ordered_search.hpp>
#include <engine/world/pose_queries.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::world {
namespace {

using geometry::to_public;
using geometry::TransformedPolygon;
using geometry::Vector;

/// The squares of lengths above it are precise.
constexpr double smallest_length = 1e-140;

/// Slightly more than a length: so that what is exactly as far away is not left out.
double with_slack(double length, double rounding) {
    return length + rounding + 4.0 * std::numeric_limits<double>::epsilon() * length;
}

/// True if a box is where a deep vertex leaves no room for the other boundary.
bool is_around(const DeepVertex& deep, const geometry::Box& box, double rounding) {
    const Vector farthest = (box.max() - deep.vertex).cwiseMax(deep.vertex - box.min());
    return with_slack(farthest.norm(), 4.0 * rounding) < deep.depth;
}

}  // namespace

void PoseQueries::begin(const Instances& instances, const geometry::Polygon& shape,
                        const WorldFilter& filter) {
    instances_ = &instances;
    shape_ = &shape;
    filter_ = filter;
    guess_ = {};
}

const simd::TransformedEdges& PoseQueries::prepared_edges() {
    shape_edges_.prepare(0);
    return edges();
}

const simd::TransformedEdges& PoseQueries::searched_edges() {
    return edges().count <= simd::max_few_edges ? edges() : prepared_edges();
}

void PoseQueries::find_candidates(const TransformedPolygon& placed) {
    // Around all turns of the shape: to know that nothing is near takes no look at its vertices.
    const Vector reach = Vector::Constant(shape_->radius());
    const geometry::Box around(placed.translation() - reach, placed.translation() + reach);
    const double rounding =
        geometry::placement_rounding(placed, around) + instances_->max_rounding();
    candidates_.clear();
    instances_->boxes().for_meeting(geometry::grown(around, rounding), [this](std::uint32_t index) {
        if (instances_->passes(index, filter_)) {
            candidates_.push_back(index);
        }
    });
}

bool PoseQueries::intersects(std::uint32_t index) {
    if (!geometry::may_meet(edges(), instances_->bounds(index))) {
        return false;
    }
    const simd::TransformedEdges& other = instances_->edges(index);
    return overlap_test_.intersect(
        is_small(edges()) && is_small(other) ? edges() : prepared_edges(), other);
}

bool PoseQueries::intersects(const TransformedPolygon& placed) {
    find_candidates(placed);
    if (candidates_.empty()) {
        guess_.instance = BoxHierarchy::nowhere;
        return false;
    }
    shape_edges_.place_alone(placed);
    // What was hit before is likely to be hit again.
    const auto before = std::find(candidates_.begin(), candidates_.end(), guess_.instance);
    if (before != candidates_.end()) {
        std::iter_swap(candidates_.begin(), before);
    }
    const auto hit = std::find_if(candidates_.begin(), candidates_.end(),
                                  [this](std::uint32_t index) { return intersects(index); });
    guess_.instance = hit == candidates_.end() ? BoxHierarchy::nowhere : *hit;
    return guess_.instance != BoxHierarchy::nowhere;
}

bool PoseQueries::intersects_guess() {
    const TransformedPolygon& placed = edges().placed;
    const double turned = (Vector(placed.rotation().col(0)) - guess_.axis).norm();
    const double moved = (placed.translation() - guess_.centre).norm() + turned * shape_->radius();
    const double slack =
        8.0 * (edges().rounding + guess_.rounding + instances_->rounding(guess_.instance)) +
        8.0 * std::numeric_limits<double>::epsilon() * std::abs(guess_.distance);
    // Had the boundaries met in between, or the deep vertex got out, something would have moved
    // that far.
    return std::abs(guess_.distance) > with_slack(moved, slack) ? guess_.distance < 0.0
                                                                : intersects(guess_.instance);
}

Vector PoseQueries::way_to_guess() {
    const simd::TransformedEdges& own = searched_edges();
    const simd::TransformedEdges& other = instances_->edges(guess_.instance);
    const auto from = [](const simd::TransformedEdges& of_vertex, std::uint32_t vertex,
                         const simd::TransformedEdges& of_edge, std::uint32_t edge) {
        const Vector start = of_vertex.start(vertex);
        return Vector(
            geometry::nearest_on_segment(start, of_edge.start(edge), of_edge.end(edge)).point -
            start);
    };
    return guess_.vertex_of_shape ? from(own, guess_.vertex, other, guess_.edge)
                                  : Vector(-from(other, guess_.edge, own, guess_.vertex));
}

void PoseQueries::find_intersecting(const TransformedPolygon& placed,
                                    std::vector<std::uint32_t>& found) {
    find_candidates(placed);
    if (candidates_.empty()) {
        return;
    }
    shape_edges_.place_alone(placed);
    std::copy_if(candidates_.begin(), candidates_.end(), std::back_inserter(found),
                 [this](std::uint32_t index) { return intersects(index); });
}

bool PoseQueries::replaces(double distance, std::uint32_t index) const {
    return distance < best_.distance ||
           (distance == best_.distance && nearest_ != BoxHierarchy::nowhere &&
            instances_->number(index) < instances_->number(nearest_));
}

void PoseQueries::write_depth(std::uint32_t index) {
    const EdgesInTree others{instances_->edges(index), &instances_->tree(index)};
    const bool is_guess = index == guess_.instance;
    std::optional<simd::AabbTree> own_tree;
    if (edges().count > simd::max_few_edges) {
        own_tree = prepared_edges().tree();
    }
    const auto of_shape = deepest_vertex_.find({edges(), own_tree ? &*own_tree : nullptr}, others,
                                               is_guess ? guess_.deep : VertexGuess());
    std::optional<DeepVertex> of_other;
    if (!of_shape || !is_around(*of_shape, edges().box, edges().rounding + others.edges.rounding)) {
        own_tree = prepared_edges().tree();
        const VertexGuess guess{is_guess ? guess_.edge : BoxHierarchy::nowhere};
        of_other = deepest_vertex_.find(others, {edges(), &*own_tree}, guess);
    }
    const double depth_of_shape = of_shape ? of_shape->depth : 0.0;
    const double depth_of_other = of_other ? of_other->depth : 0.0;
    const double depth = std::max(depth_of_shape, depth_of_other);
    if (!replaces(-depth, index)) {
        return;
    }
    nearest_ = index;
    nearest_vertex_ = of_shape ? of_shape->index : 0;
    nearest_edge_ = of_other ? of_other->index : 0;
    nearest_deep_ = of_shape ? VertexGuess{of_shape->index, of_shape->edge} : VertexGuess();
    best_ = {};
    best_.distance = 0.0 - depth;
    best_.error_bound = edges().rounding + instances_->rounding(index) + shape_->deviation() +
                        instances_->deviation(index);
    if (depth == 0.0) {
        return;
    }
    const bool is_of_shape = depth_of_shape >= depth_of_other;
    const DeepVertex& deep = is_of_shape ? *of_shape : *of_other;
    const Vector way = (deep.nearest - deep.vertex) / deep.depth;
    best_.point = to_public(is_of_shape ? deep.vertex : deep.nearest);
    best_.nearest = to_public(is_of_shape ? deep.nearest : deep.vertex);
    // The instance's vertex leaves the shape the opposite way.
    best_.direction = to_public(is_of_shape ? way : Vector(-way));
}

void PoseQueries::write_distance(std::uint32_t index, double max_clearance) {
    const simd::TransformedEdges& other = instances_->edges(index);
    const double rounding = edges().rounding + other.rounding;
    double known = std::min(best_.distance, max_clearance);
    Vector direction = Vector::Zero();
    if (index == guess_.instance) {
        // What was nearest at the pose before is still near, and in about the same direction.
        const Vector way = way_to_guess();
        const double length = way.norm();
        known = std::min(known, length);
        // Slightly shorter than a unit vector; (0, 0) rules nothing out.
        direction = length > smallest_length ? Vector(way * ((1.0 - 1e-12) / length)) : direction;
    }
    const double at_most = with_slack(known, 4.0 * rounding);
    const narrowphase::ClosestPair pair =
        edges().count <= simd::max_few_edges
            ? closest_pair_.find_of_few(edges(), other, instances_->tree(index), at_most, direction)
            : closest_pair_.find(prepared_edges(), other, at_most, 0.0);
    const double distance = std::sqrt(pair.squared_distance);
    if (distance > max_clearance || !replaces(distance, index)) {
        return;
    }
    nearest_ = index;
    nearest_vertex_ = pair.edge_a;
    nearest_edge_ = pair.edge_b;
    nearest_is_vertex_of_shape_ = pair.parameter_a == 0.0;
    best_.distance = distance;
    best_.error_bound = rounding + shape_->deviation() + instances_->deviation(index) +
                        8.0 * std::numeric_limits<double>::epsilon() * distance;
    best_.point = to_public(pair.point_a);
    best_.nearest = to_public(pair.point_b);
    best_.direction =
        distance > 0.0 ? to_public((pair.point_b - pair.point_a) / distance) : Vector2();
}

void PoseQueries::measure(std::uint32_t index, bool intersects, const ClearanceQuery& query) {
    if (!intersects) {
        if (!(best_.distance < 0.0)) {
            write_distance(index, query.max_clearance);
        }
    } else if (query.min_clearance >= 0.0) {
        best_.distance = 0.0;  // how deep is of no interest
        nearest_ = index;
        nearest_vertex_ = nearest_edge_ = 0;
    } else {
        write_depth(index);
    }
}

Clearance PoseQueries::clearance(const TransformedPolygon& placed, const ClearanceQuery& query) {
    shape_edges_.place_alone(placed);
    best_ = {};
    nearest_ = BoxHierarchy::nowhere;
    const std::uint32_t guess = guess_.instance;
    if (guess != BoxHierarchy::nowhere) {
        measure(guess, intersects_guess(), query);
    }
    const double rounding = edges().rounding + instances_->max_rounding();
    const auto bound = [&] {
        const double farthest = std::min(best_.distance, query.max_clearance);
        const double distance = with_slack(std::max(farthest, 0.0), 4.0 * rounding);
        return best_.distance <= query.min_clearance ? -1.0 : distance * distance;
    };
    instances_->boxes().for_near(edges().box, bound, [&](std::uint32_t index, double) {
        if (index != guess && instances_->passes(index, filter_)) {
            measure(index, intersects(index), query);
        }
    });
    guess_ = {nearest_,
              nearest_vertex_,
              nearest_edge_,
              nearest_is_vertex_of_shape_,
              nearest_deep_,
              best_.distance,
              placed.rotation().col(0),
              placed.translation(),
              edges().rounding};
    if (nearest_ == BoxHierarchy::nowhere || best_.distance <= query.min_clearance) {
        best_ = {};
        best_.distance =
            nearest_ == BoxHierarchy::nowhere ? query.max_clearance : query.min_clearance;
        return best_;
    }
    best_.instance = instances_->handle(nearest_);
    return best_;
}

void PoseQueries::find_nearest(const TransformedPolygon& placed, double max_distance,
                               std::span<Clearance> nearest) {
    shape_edges_.place_alone(placed);
    guess_ = {};
    found_.begin(nearest.size(), max_distance);
    const double rounding = edges().rounding + instances_->max_rounding();
    instances_->boxes().for_near(
        edges().box, [&] { return found_.squared_reach(4.0 * rounding); },
        [&](std::uint32_t index, double) {
            if (!instances_->passes(index, filter_)) {
                return;
            }
            best_ = {};
            nearest_ = BoxHierarchy::nowhere;
            measure(index, intersects(index), {.max_clearance = found_.reach()});
            best_.instance = instances_->handle(index);
            if (nearest_ != BoxHierarchy::nowhere) {
                found_.offer({{best_.distance, instances_->number(index), index, 0}, best_});
            }
        });
    std::fill(nearest.begin(), nearest.end(), Clearance{});
    std::transform(found_.found().begin(), found_.found().end(), nearest.begin(),
                   [](const Found& found) { return found.clearance; });
}

}  // namespace nearfield::world
