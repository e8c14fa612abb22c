#include <engine/base/interruption.hpp>
#include <engine/plan/asked_points.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/plan/edge_sampler.hpp>
#include <engine/plan/point_search.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::plan {

using geometry::Polygon;
using geometry::Vector;

namespace {

bool asks_for_vertices(const PlannedQuery& query) {
    const auto* const penetration = std::get_if<PenetrationQuery>(query.query);
    return penetration != nullptr && penetration->points == PenetrationPoints::vertices;
}

// Transforms A's frame to B's, in units of B's. Everything happens in floats, in a handful of
// operations, each of which errs by at most 2^-24 of its result: 2^-20 of the largest coordinates
// covers them.
SearchDirectionData direction_of(const PlannedQuery& query, const Vector& axis,
                                 const Vector& offset) {
    SearchDirectionData data;
    const double unit = unit_length_of(*query.b);
    const Vector axis_in_units = unit_length_of(*query.a) / unit * axis;
    const Vector offset_in_units = offset / unit;
    data.axis = {static_cast<float>(axis_in_units.x()), static_cast<float>(axis_in_units.y())};
    data.offset = {static_cast<float>(offset_in_units.x()),
                   static_cast<float>(offset_in_units.y())};
    const double extent = (query.a->radius() + query.b->radius()) / unit + offset_in_units.norm();
    const double cell = query.budget.cell / unit;
    data.reach = query.points().outside ? rounded_up(reach_of(query) / unit) : 0.0F;
    data.margin = rounded_up(std::ldexp(extent, -20));
    data.rival = static_cast<float>(cell / std::numbers::sqrt2 * uniqueness_margin);
    data.outside = query.points().outside ? 1.0F : 0.0F;
    data.doubt = data.margin > search_precision * cell ? data.rival + 4.0F * data.margin : -1.0F;
    const auto touching =
        static_cast<float>(cell / std::numbers::sqrt2 * static_cast<double>(touching_depth));
    data.touching = query.points().summarized ? touching : -touching;
    return data;
}

}  // namespace

SearchedQuery searched_query(std::uint32_t index, const PlannedQuery& query, const Vector& axis,
                             const Vector& offset) {
    return {index,
            query.a,
            query.b,
            asks_for_vertices(query) ? 0.0 : query.budget.cell,
            max_points(query),
            direction_of(query, axis, offset)};
}

void FoundPlaces::enter(std::uint32_t edge) {
    const std::span<const Vector> vertices = a_.vertices();
    edge_ = edge;
    parts_ = parts_of_length((vertices[a_.next(edge)] - vertices[edge]).norm(), cell_);
}

void GivenPairsBuilder::build(const Plan& plan, std::uint64_t largest_range, GivenPairs& pairs) {
    pairs.clear();
    if (plan.searched.empty()) {
        return;
    }
    shapes_.begin_batch();
    fill(plan, pairs);
    if (shapes_.units().size_bytes() > largest_range) {
        shapes_.clear();
        pairs.clear();
        fill(plan, pairs);
    }
}

void GivenPairsBuilder::fill(const Plan& plan, GivenPairs& pairs) {
    SparseCheckpoint<64> checkpoint;
    for (const SearchedQuery& searched : plan.searched) {
        checkpoint.step();
        SearchDirectionData& data = pairs.directions.emplace_back(searched.data);
        data.a = searched.query;
        data.shape_a = shapes_.place(*searched.a);
        data.shape_b = shapes_.place(*searched.b);
        if (searched.spacing > 0.0) {
            data.parts = shapes_.place_parts(*searched.a, searched.spacing);
        }
        data.first_item = pairs.items;
        pairs.items += shapes_.units()[data.shape_a][0];  // its number of chunks
        pairs.max_edges += static_cast<double>(searched.a->size());
        pairs.max_points += searched.max_points;
    }
}

}  // namespace nearfield::plan
