#include <engine/device_input/check_target.hpp>
#include <engine/device_input/compute_work.hpp>
#include <engine/device_input/field_planner.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/field_grid.hpp>

#include <algorithm>
#include <span>
#include <string>

namespace nearfield::device_input {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Side of a field's tiles in cells, without the halo.
std::uint32_t side_of_tiles(const PlannedQuery& planned, bool at_points,
                            const queries::QueryLimits& limits) {
    const queries::FieldParts& parts = planned.field().parts;
    // By compute, cells have lists of their blocks, and points need no lists.
    const bool small_tiles = planned.technique == Technique::compute
                                 ? at_points && !parts.values && !parts.features
                                 : parts.small_tiles;
    const std::uint32_t drawn =
        small_tiles ? std::min(limits.features_tile, limits.largest_tile) : limits.largest_tile;
    return drawn - 2 * parts.halo;
}

/// Not less than the distance of a point from the nearest vertex of a polygon in a tight box: each
/// side of the box has a vertex.
double bound_on_distance(const Vector& point, const Box& box) {
    const Vector to_low = (point - box.min()).cwiseAbs();
    const Vector to_high = (point - box.max()).cwiseAbs();
    const Vector near = to_low.cwiseMin(to_high);
    const Vector far = to_low.cwiseMax(to_high);
    return std::min(Vector(near.x(), far.y()).norm(), Vector(far.x(), near.y()).norm());
}

/// Checks that the images of a resident field fit the device; the result states the error.
bool check_resident(const DistanceFieldQuery& query, const queries::Grid& grid,
                    std::uint32_t largest_image, const PlannedQuery& planned, const Box& box_b,
                    PlannedField& field, DistanceFieldResult& result) {
    if (std::max(grid.width, grid.height) > largest_image) {
        result.status = {
            StatusCode::too_large,
            "a field of " + std::to_string(grid.width) + " x " + std::to_string(grid.height) +
                " cells is to stay on the device; an image of this device has at most " +
                std::to_string(largest_image) +
                " along a side; use a larger tolerance or a smaller rectangle"};
        return false;
    }
    if (query.target != nullptr) {
        result.status = check_room(*query.target, grid.width, grid.height);
        if (!result.status.ok()) {
            return false;
        }
    }
    // Distances change by at most the distance moved.
    const Vector half =
        0.5 * grid.cell * Vector(static_cast<double>(grid.width), static_cast<double>(grid.height));
    field.farthest = bound_on_distance(grid.origin + half, box_b) + half.norm();
    result.status = queries::check_distance(
        result.tolerance, planned.budget.bound + queries::far_rounding * field.farthest,
        field.farthest);
    return result.status.ok();
}

}  // namespace

void FieldPlanner::plan(const DistanceFieldQuery& query, CurrentQuery& current,
                        DistanceFieldResult& result) {
    const queries::QueryLimits& limits = current.limits;
    PlannedQuery& planned = current.planned();
    const std::optional<queries::Grid> grid = queries::grid_of_field(planned, result);
    if (!grid) {
        return;
    }
    auto& field = planned.work.emplace<PlannedField>();
    field.parts = queries::field_parts(query);
    const Box box_b = TransformedPolygon(*planned.b, planned.pose_b).box();
    if (planned.on_device &&
        !check_resident(query, *grid, limits.largest_image, planned, box_b, field, result)) {
        return;
    }
    regions_.set(*grid);
    const std::uint32_t side = side_of_tiles(planned, !query.points.empty(), limits);
    current.memory.require(
        queries::bytes_of_field(query, field.parts, *grid, side) +
            (planned.technique == Technique::compute && (field.parts.values || field.parts.features)
                 ? bytes_of_masks(regions_, 1, limits.largest_tile) +
                       bytes_of_field_lists(grid->cells())
                 : 0.0),
        2.0);
    const auto first_tile = static_cast<std::uint32_t>(current.plan.tiles.size());
    field.first_point = static_cast<std::uint32_t>(current.plan.field_points.size());
    field.point_count = static_cast<std::uint32_t>(query.points.size());
    result.status = queries::place_points(query, field.parts, *grid, {side, first_tile},
                                          current.plan.field_points);
    if (!result.status.ok()) {
        return;
    }
    queries::make_room(query, *grid, field.parts, result);
    add_tiles(regions_, TileKind::field, side, field.parts.halo, current);
    if (!field.parts.values && !field.parts.features) {
        drop_tiles_without_points(first_tile, field, current.plan);
    }
}

void FieldPlanner::drop_tiles_without_points(std::uint32_t first_tile, const PlannedField& field,
                                             Plan& plan) {
    const std::span points(plan.field_points.data() + field.first_point, field.point_count);
    kept_tiles_.assign(plan.tiles.size() - first_tile, 0);
    for (const queries::PlacedFieldPoint& point : points) {
        kept_tiles_[point.tile - first_tile] = 1;
    }
    std::uint32_t next = first_tile;
    for (std::uint32_t i = 0; i < kept_tiles_.size(); ++i) {
        if (kept_tiles_[i] != 0) {
            plan.tiles[next] = plan.tiles[first_tile + i];
            kept_tiles_[i] = next++;
        }
    }
    plan.tiles.resize(next);
    for (queries::PlacedFieldPoint& point : points) {
        point.tile = kept_tiles_[point.tile - first_tile];
    }
}

}  // namespace nearfield::device_input
