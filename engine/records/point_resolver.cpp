#include <engine/base/interruption.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/plan/asked_points.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/records/nearest_feature.hpp>
#include <engine/records/point_resolver.hpp>

#include <shaders/search.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::records {

using geometry::Vector;

namespace {

/// Beyond this many cells, single precision cannot resolve a thousandth of d: the nearest edge is
/// determined again, in double precision.
constexpr double farthest_in_single_precision = 1024.0;

}  // namespace

void PointResolver::begin(const plan::Plan& plan, const plan::PlannedQuery& query,
                          std::span<const std::uint32_t> words) {
    plan_ = &plan;
    query_ = &query;
    words_ = words;
    a_ = recent_.place(*query.a, query.pose_a);
    positions_.emplace(*a_);
    b_ = recent_.place(*query.b, query.pose_b);
    boundary_is_set_ = false;
    points_.clear();
    next_ = 0;
    rounding_ = query.technique == Technique::cpu ? localize::placement_rounding(*a_, a_->box()) +
                                                        localize::placement_rounding(*b_, b_->box())
                                                  : 0.0;
}

narrowphase::Boundary& PointResolver::boundary_of_b() {
    if (!boundary_is_set_) {
        instances_.clear();
        const std::uint32_t index = instances_.place(*b_);
        instances_.complete(index);
        boundary_.set(instances_[index]);
        boundary_is_set_ = true;
    }
    return boundary_;
}

/// Locates the points in doubt from an index on, as many as are located at once.
void PointResolver::locate_doubtful(std::uint32_t first) {
    static_cast<void>(boundary_of_b());
    const simd::TransformedEdges& b = instances_[0];
    const std::uint32_t end = query_->points().end();
    const std::size_t at_once = narrowphase::points_at_once(b.count);
    points_.clear();
    next_ = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::uint32_t i = first; i < end && points_.size() < at_once; ++i) {
        checkpoint.step();
        if ((words_[i] & plan::point_doubtful) != 0) {
            const Vector point = position(*a_, plan_->points[i].point);
            points_.reserve(points_.size() + 1);
            points_.push(point.x(), point.y());
        }
    }
    located_.find(points_.arrays(), b,
                  {.margin = query_->budget.cell / std::numbers::sqrt2 * plan::uniqueness_margin,
                   .touching = localize::placement_rounding(*a_, a_->box()) + b.rounding,
                   .reach = plan::reach_of(*query_)});
}

PointResolver::Found PointResolver::find_doubtful(std::uint32_t index) {
    if (next_ == points_.size()) {
        locate_doubtful(index);
    }
    const std::uint32_t i = next_++;
    const std::uint32_t edge = located_.nearest().edge[i];
    const Vector point = position(*a_, plan_->points[index].point);
    const bool is_near = located_.nearest().distance[i] <= plan::reach_of(*query_);
    return {{edge, nearest_on_edge(*b_, edge, point)},
            is_near && located_.is_inside(i),
            located_.is_unique(i)};
}

/// The nearest point of B for one that the device searched: of the edge that it named and its
/// neighbours, among which single precision may not have been able to choose.
narrowphase::NearestPoint PointResolver::nearest_of_neighbours(const Vector& point,
                                                               std::uint32_t edge) const {
    const geometry::Polygon& polygon = b_->polygon();
    narrowphase::NearestPoint nearest{edge, nearest_on_edge(*b_, edge, point)};
    for (const std::uint32_t other : {polygon.previous(edge), polygon.next(edge)}) {
        const geometry::NearestOnSegment on_other = nearest_on_edge(*b_, other, point);
        if (on_other.squared_distance < nearest.on_edge.squared_distance) {
            nearest = {other, on_other};
        }
    }
    return nearest;
}

PointResolver::Found PointResolver::find(const Vector& point, std::uint32_t index) {
    const std::uint32_t word = words_[index];
    if ((word & plan::point_doubtful) != 0) {
        return find_doubtful(index);
    }
    const std::uint32_t edge = word & plan::point_edge_mask;
    const double tolerance = query_->budget.cell / std::numbers::sqrt2;
    Found found{{edge, {}}, (word & plan::point_inside) != 0, (word & plan::point_unique) != 0};
    if (query_->points().margin > plan::search_precision * query_->budget.cell) {
        found.nearest = nearest_of_neighbours(point, edge);
        return found;
    }
    found.nearest.on_edge = nearest_on_edge(*b_, edge, point);
    const double far = farthest_in_single_precision * query_->budget.cell;
    if (query_->points().source != plan::PointSource::device &&
        found.nearest.on_edge.squared_distance > far * far) {
        found.nearest = boundary_of_b().nearest(point);
        found.unique =
            boundary_of_b().is_unique(point, found.nearest, tolerance * plan::uniqueness_margin);
    }
    return found;
}

/// Points nearer to the boundary than this touch it.
double PointResolver::touching(const plan::PlannedPoint& planned) const {
    if (query_->technique == Technique::cpu) {
        return rounding_;
    }
    return query_->points().source == plan::PointSource::device
               ? touching_distance(query_->budget.cell, 0)
               : touching_distance(plan_->tiles[planned.tile]);
}

ResolvedPoint PointResolver::resolve(std::uint32_t index) {
    const plan::PlannedPoint& planned = plan_->points[index];
    const Vector point = (*positions_)(planned.point);
    const Found found = find(point, index);
    const geometry::NearestOnSegment& on_edge = found.nearest.on_edge;
    const double distance = std::sqrt(on_edge.squared_distance);
    return {point,
            on_edge.point,
            distance,
            found.nearest.edge,
            on_edge.parameter,
            feature_at(*b_, found.nearest.edge, on_edge.parameter),
            found.inside && distance > touching(planned),
            found.unique};
}

/// Whether a point that the device has found is inside B and deeper than `depth` for certain.
bool PointResolver::is_deeper(std::uint32_t index, double depth) const {
    constexpr std::uint32_t side = plan::point_inside | plan::point_doubtful;
    return (words_[index] & side) == plan::point_inside &&
           plan_->points[index].depth > depth + plan::depth_margins * query_->points().margin;
}

PenetrationSummary PointResolver::summarize_penetration(double tolerance) {
    const double touching = tolerance * static_cast<double>(plan::touching_depth);
    const plan::PlannedPoints& points = query_->points();
    double deepest = 0.0;
    for (std::uint32_t i = points.first; i < points.end(); ++i) {
        if (is_deeper(i, touching)) {
            deepest = std::max(deepest, static_cast<double>(plan_->points[i].depth));
        }
    }
    // Points that are not as deep as this are not the deepest.
    const double deep = deepest - 2.0 * plan::depth_margins * points.margin;
    PenetrationSummary summary;
    summary.count = points.left_out;
    for (std::uint32_t i = points.first; i < points.end(); ++i) {
        const bool is_certain = is_deeper(i, touching);
        if (is_certain && plan_->points[i].depth < deep) {
            ++summary.count;
            continue;
        }
        const ResolvedPoint resolved = resolve(i);
        if (is_certain || (resolved.inside && resolved.distance > touching)) {
            ++summary.count;
            if (resolved.distance > summary.deepest.depth) {
                summary.deepest = penetration_record(resolved);
            }
        }
    }
    return summary;
}

}  // namespace nearfield::records
