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

/// Points that are not deeper only touch. Precondition: a penetration query.
double touching_of(const PlannedQuery& query) {
    return std::get<PenetrationQuery>(*query.query).tolerance * static_cast<double>(touching_depth);
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
    data.touching =
        query.points().summarized ? static_cast<float>(touching_of(query) / unit) : -1.0F;
    return data;
}

/// Whether the scratch memory of a search, which is the largest of its buffers, has room for
/// another query, even if all its edges and points are looked at (render::ScratchLayout).
bool has_room(const PointSearch& search, const SearchedQuery& more, std::uint64_t largest_range) {
    // 20 bytes and a little for sums. Of each edge 32, 8 for each chunk, of which there is one per
    // three edges at most, and three points for each direction, which has at least three edges.
    constexpr double bytes_per_point = 21.0;
    constexpr double bytes_per_edge = 60.0;
    constexpr double few = 1U << 16U;
    // Vulkan promises that so much can be allocated at once.
    constexpr std::uint64_t largest_allocation = std::uint64_t{1} << 30U;
    // Their data takes a quarter of the least range that Vulkan promises.
    constexpr std::size_t max_directions = std::size_t{1} << 19U;
    const double bytes = bytes_per_point * (search.max_points + more.max_points) +
                         bytes_per_edge * (search.max_edges + static_cast<double>(more.a->size()));
    return bytes + few <= static_cast<double>(std::min(largest_range, largest_allocation)) &&
           search.directions.size() < max_directions;
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

std::size_t PointSearchBuilder::build(const Plan& plan, std::uint64_t largest_range,
                                      std::vector<PointSearch>& searches) {
    if (plan.searched.empty()) {
        return 0;
    }
    shapes_.begin_batch();
    std::size_t count = fill(plan, largest_range, searches);
    if (shapes_.units().size_bytes() > largest_range) {
        shapes_.clear();
        count = fill(plan, largest_range, searches);
    }
    return count;
}

std::size_t PointSearchBuilder::fill(const Plan& plan, std::uint64_t largest_range,
                                     std::vector<PointSearch>& searches) {
    std::size_t count = 0;
    for (const SearchedQuery& searched : plan.searched) {
        checkpoint();
        if (count == 0 || !has_room(searches[count - 1], searched, largest_range)) {
            searches.resize(std::max(searches.size(), ++count));
            searches[count - 1].clear();
        }
        PointSearch& search = searches[count - 1];
        search.max_points += searched.max_points;
        search.max_edges += static_cast<double>(searched.a->size());
        add(searched, search);
    }
    return count;
}

void PointSearchBuilder::add(const SearchedQuery& searched, PointSearch& search) {
    SearchDirectionData& data = search.directions.emplace_back(searched.data);
    search.summarizes = search.summarizes || data.touching >= 0.0F;
    data.shape_a = shapes_.place(*searched.a);
    data.shape_b = shapes_.place(*searched.b);
    if (searched.spacing > 0.0) {
        data.parts = shapes_.place_parts(*searched.a, searched.spacing);
    }
    data.first_item = search.items;
    // Of each block of items, the direction of its first one.
    const auto direction = static_cast<std::uint32_t>(search.queries.size());
    const std::uint32_t end =
        search.items + shapes_.units()[data.shape_a][0];  // its number of chunks
    while (search_block * search.first_directions.size() < end) {
        search.first_directions.push_back(direction);
    }
    search.items = end;
    search.queries.push_back(searched.query);
}

}  // namespace nearfield::plan
