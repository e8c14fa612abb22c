#include <engine/base/interruption.hpp>
#include <engine/device_input/point_search.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/edge_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::device_input {

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
shaders::SearchDirectionData direction_of(const PlannedQuery& query, const Vector& axis,
                                          const Vector& offset) {
    shaders::SearchDirectionData data;
    const double unit = unit_length_of(*query.b);
    const Vector axis_in_units = unit_length_of(*query.a) / unit * axis;
    const Vector offset_in_units = offset / unit;
    data.axis = {static_cast<float>(axis_in_units.x()), static_cast<float>(axis_in_units.y())};
    data.offset = {static_cast<float>(offset_in_units.x()),
                   static_cast<float>(offset_in_units.y())};
    const double extent = (query.a->radius() + query.b->radius()) / unit + offset_in_units.norm();
    const double cell = query.budget.cell / unit;
    data.reach = query.points().outside ? rounded_up(reach_of(query) / unit) : 0.0F;
    data.margin = rounded_up(0x1p-20 * extent);
    data.rival = static_cast<float>(cell / std::numbers::sqrt2 * queries::uniqueness_margin);
    data.outside = query.points().outside ? 1.0F : 0.0F;
    data.doubt =
        data.margin > queries::search_precision * cell ? data.rival + 4.0F * data.margin : -1.0F;
    const auto touching = static_cast<float>(cell / std::numbers::sqrt2 *
                                             static_cast<double>(shaders::touching_depth));
    data.touching = query.points().summarized ? touching : -touching;
    return data;
}

}  // namespace

void FoundPlaces::enter(std::uint32_t edge) {
    const std::span<const Vector> vertices = a_.vertices();
    edge_ = edge;
    parts_ = queries::parts_of_length((vertices[a_.next(edge)] - vertices[edge]).norm(), cell_);
}

double GivenPairsBuilder::add(std::uint32_t index, const PlannedQuery& query, const Vector& axis,
                              const Vector& offset, GivenPairs& pairs) {
    if (pairs.directions.empty()) {
        shapes_.begin_batch();
    }
    shaders::SearchDirectionData& data =
        pairs.directions.emplace_back(direction_of(query, axis, offset));
    data.a = index;
    place(query, data);
    data.first_item = pairs.items;
    pairs.items += shapes_.units()[data.shape_a][0];  // its number of chunks
    pairs.max_edges += static_cast<double>(query.a->size());
    pairs.max_points += queries::max_points(query);
    return static_cast<double>(data.margin) * unit_length_of(*query.b);
}

void GivenPairsBuilder::place(const PlannedQuery& query, shaders::SearchDirectionData& data) {
    data.shape_a = shapes_.place(*query.a);
    data.shape_b = shapes_.place(*query.b);
    if (!asks_for_vertices(query)) {
        data.parts = shapes_.place_parts(*query.a, query.budget.cell);
    }
}

void GivenPairsBuilder::fit(std::uint64_t largest_range, Plan& plan) {
    if (plan.pairs.directions.empty() || shapes_.units().size_bytes() <= largest_range) {
        return;
    }
    shapes_.clear();
    SparseCheckpoint<64> checkpoint;
    for (shaders::SearchDirectionData& data : plan.pairs.directions) {
        checkpoint.step();
        place(plan.queries[data.a], data);
    }
}

double reach_of(const PlannedQuery& query) {
    const auto* const contacts = std::get_if<ContactQuery>(query.query);
    return contacts == nullptr ? std::numeric_limits<double>::infinity()
                               : contacts->contact_distance;
}

}  // namespace nearfield::device_input
