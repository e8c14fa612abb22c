#include <engine/base/interruption.hpp>
#include <engine/batch/point_resolver.hpp>
#include <engine/device_input/point_search.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/solvers/nearest_feature.hpp>

#include <shaders/search.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::batch {

using geometry::Vector;

namespace {

/// Beyond this many cells, single precision cannot resolve a thousandth of d: the nearest edge is
/// determined again, in double precision.
constexpr double farthest_in_single_precision = 1024.0;

}  // namespace

/// The points that the device has found, as if they had been planned.
void PointResolver::take(std::span<const shaders::FoundPointData> found) {
    places_of_found_.resize(found.size());
    words_of_found_.resize(found.size());
    device_input::FoundPlaces place_of(*query_);
    for (std::size_t i = 0; i < found.size(); ++i) {
        places_of_found_[i] = {place_of(found[i]), device_input::PlannedPoint::no_tile};
        words_of_found_[i] = found[i].word;
    }
    places_ = places_of_found_;
    words_ = words_of_found_;
}

void PointResolver::begin(const device_input::PlannedQuery& query,
                          const geometry::TransformedPolygon& a,
                          const geometry::TransformedPolygon& b, const QueryPoints& points) {
    query_ = &query;
    places_ = points.points;
    words_ = points.words;
    tiles_ = points.tiles;
    if (!points.found.empty()) {
        take(points.found);
    }
    a_ = a;
    positions_.emplace(*a_);
    b_ = b;
    boundary_is_set_ = false;
    points_.clear();
    next_ = 0;
    block_.begin(*b_);
    const bool by_search = query.points().source == device_input::PointSource::device;
    has_close_neighbours_ = query.points().margin > queries::search_precision * query.budget.cell;
    farthest_ = by_search || has_close_neighbours_
                    ? std::numeric_limits<double>::infinity()
                    : farthest_in_single_precision * query.budget.cell;
    touching_.reset();
    if (by_search) {
        touching_ = solvers::touching_distance(query.budget.cell, 0);
    }
}

narrowphase::Boundary& PointResolver::boundary_of_b() {
    if (!boundary_is_set_) {
        instances_.place_alone(*b_);
        instances_.complete(0);
        boundary_.set(instances_[0]);
        boundary_is_set_ = true;
    }
    return boundary_;
}

/// Locates the points in doubt from an index on, as many as are located at once.
void PointResolver::locate_doubtful(std::uint32_t first) {
    static_cast<void>(boundary_of_b());
    const simd::TransformedEdges& b = instances_[0];
    const auto end = static_cast<std::uint32_t>(places_.size());
    const std::size_t at_once = narrowphase::points_at_once(b.count);
    points_.clear();
    next_ = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::uint32_t i = first; i < end && points_.size() < at_once; ++i) {
        checkpoint.step();
        if ((words_[i] & shaders::point_doubtful) != 0) {
            const Vector point = position(*a_, places_[i].point);
            points_.reserve(points_.size() + 1);
            points_.push(point.x(), point.y());
        }
    }
    located_.find(points_.arrays(), b,
                  {.margin = query_->budget.cell / std::numbers::sqrt2 * queries::uniqueness_margin,
                   .touching = geometry::placement_rounding(*a_, a_->box()) + b.rounding,
                   .reach = device_input::reach_of(*query_)});
}

/// Finds the nearest points, sides and what else the words of the block's points tell.
void PointResolver::resolve_block() {
    block_.find(has_close_neighbours_);
    for (std::uint32_t i = 0; i < block_.size(); ++i) {
        sides_[i] = words_[block_.index(i)];
        if ((sides_[i] & shaders::point_doubtful) != 0) {
            sides_[i] = resolve_doubtful(i);
        } else if (block_.distance(i) > farthest_) {
            sides_[i] = resolve_far(i);
        }
    }
}

/// A point of the block that the device left in doubt. Returns its word.
std::uint32_t PointResolver::resolve_doubtful(std::uint32_t i) {
    if (next_ == points_.size()) {
        locate_doubtful(block_.index(i));
    }
    const std::uint32_t place = next_++;
    const std::uint32_t edge = located_.nearest().edge[place];
    block_.set(i, {edge, solvers::nearest_on_edge(*b_, edge, block_.point(i))});
    const bool is_near = located_.nearest().distance[place] <= device_input::reach_of(*query_);
    return (is_near && located_.is_inside(place) ? shaders::point_inside : 0U) |
           (located_.is_unique(place) ? shaders::point_unique : 0U);
}

/// A point of the block whose nearest edge single precision may not have found. Returns its word.
std::uint32_t PointResolver::resolve_far(std::uint32_t i) {
    const Vector point = block_.point(i);
    const double margin = query_->budget.cell / std::numbers::sqrt2 * queries::uniqueness_margin;
    const narrowphase::NearestPoint nearest = boundary_of_b().nearest(point);
    block_.set(i, nearest);
    const bool is_unique = boundary_of_b().is_unique(point, nearest, margin);
    return (sides_[i] & shaders::point_inside) | (is_unique ? shaders::point_unique : 0U);
}

std::size_t PointResolver::list_penetrations(double tolerance,
                                             std::vector<PenetratingPoint>& records) {
    records.resize(places_.size());
    std::size_t count = 0;
    std::size_t deepest = 0;
    double depth = 0.0;
    for_each_penetration(tolerance, [&](const solvers::ResolvedPoint& resolved) {
        write(resolved, records[count]);
        if (resolved.distance > depth) {
            depth = resolved.distance;
            deepest = count;
        }
        ++count;
    });
    records.resize(count);
    return deepest;
}

PenetrationSummary PointResolver::summarize_penetration(double tolerance) {
    PenetrationSummary summary;
    for_each_penetration(tolerance, [&](const solvers::ResolvedPoint& resolved) {
        if (resolved.distance > summary.deepest.depth) {
            write(resolved, summary.deepest);
        }
        ++summary.count;
    });
    return summary;
}

PenetrationSummary PointResolver::summarize_penetration(const device_input::PlannedQuery& query,
                                                        const geometry::TransformedPolygon& a,
                                                        const geometry::TransformedPolygon& b,
                                                        const shaders::PairRowData& row,
                                                        double tolerance) {
    const shaders::FoundPointData deepest{0, row.edge, row.number, row.word};
    begin(query, a, b, {.found = {&deepest, 1}});
    PenetrationSummary summary = summarize_penetration(tolerance);
    summary.count = row.count & shaders::row_count_mask;
    return summary;
}

}  // namespace nearfield::batch
