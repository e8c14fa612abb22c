#include <engine/geometry/magnitude.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/check_target.hpp>
#include <engine/plan/compute_work.hpp>
#include <engine/plan/field_planner.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Bytes of the requested outputs at cells: in the result, and on the way there in tiles of at most
/// `side` cells drawn with their halos.
double bytes_of_cells(const DistanceFieldQuery& query, const FieldParts& parts, const Grid& grid,
                      double side) {
    const double images = query.features_on_device ? 2.0 : 1.0;
    const double resident = query.on_device ? images * sizeof(std::uint32_t) : 0.0;
    const double result = resident + (query.values ? sizeof(float) : 0.0) +
                          (query.features ? sizeof(Feature) : 0.0) +
                          (query.gradients ? 2.0 * sizeof(float) : 0.0) +
                          (parts.host_features ? sizeof(std::uint8_t) : 0.0);
    const double words =
        (parts.values ? 1.0 : 0.0) + (parts.features ? 1.0 : 0.0) + (parts.gradients ? 2.0 : 0.0);
    const auto drawn = [&](std::uint64_t cells) {
        const auto count = static_cast<double>(cells);
        return count + 2.0 * parts.halo * std::ceil(count / side);
    };
    // The signs of a field on the CPU.
    const double signs = parts.values || parts.features ? 1.0 / 8.0 : 0.0;
    const double tiles = std::ceil(static_cast<double>(grid.width) / side) *
                         std::ceil(static_cast<double>(grid.height) / side);
    return result * grid.cells() + sizeof(Tile) * tiles +
           (words * sizeof(std::uint32_t) + signs) * drawn(grid.width) * drawn(grid.height);
}

double bytes_of_points(const DistanceFieldQuery& query, const FieldParts& parts) {
    const double words = parts.words_per_point * sizeof(std::uint32_t);
    return static_cast<double>(query.points.size()) *
           (sizeof(FieldPoint) + sizeof(PlannedFieldPoint) + 2.0 * sizeof(PointData) + words);
}

void make_room(const DistanceFieldQuery& query, const Grid& grid, const FieldParts& parts,
               DistanceFieldResult& result) {
    const std::size_t cells = grid.width * grid.height;
    result.origin = geometry::to_public(grid.origin);
    result.width = static_cast<std::uint32_t>(grid.width);
    result.height = static_cast<std::uint32_t>(grid.height);
    result.values.resize(query.values ? cells : 0);
    result.features.resize(query.features ? cells : 0);
    result.gradients.resize(query.gradients ? 2 * cells : 0);
    result.unique.resize(parts.host_features ? cells : 0);
    result.points.resize(query.points.size());
}

std::string place(const Vector& point) {
    return "(" + number(point.x()) + ", " + number(point.y()) + ")";
}

/// The box that a field covers; empty if there is none, and then the result states why.
std::optional<Box> box_of(const DistanceFieldQuery& query, const PlannedQuery& planned,
                          ResultSummary& result) {
    if (query.rectangle) {
        return Box(geometry::to_vector(query.rectangle->min),
                   geometry::to_vector(query.rectangle->max));
    }
    const Box box_a = TransformedPolygon(*planned.a, planned.pose_a).box();
    const Box box = box_a.intersection(TransformedPolygon(*planned.b, planned.pose_b).box());
    if (box.isEmpty()) {
        result.status = {StatusCode::invalid_query,
                         "the bounding boxes of A and B have nothing in common; give the "
                         "rectangle the distance field is to cover"};
        return std::nullopt;
    }
    return geometry::grown(box, query.tolerance);
}

/// Checks that tolerance and deviations are compatible with coordinates and distances this large;
/// the result states the error.
bool check_numbers(const PlannedQuery& planned, const Box& box, const TransformedPolygon& b,
                   const Box& box_b, ResultSummary& result) {
    const double tolerance = result.tolerance;
    result.status = check_deviations(tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            tolerance, std::max(geometry::largest_magnitude(box),
                                geometry::largest_magnitude(b, planned.pose_b, box_b)));
    }
    if (result.status.ok()) {
        // No cell is nearer to B than the boxes are to each other: a field too far away is rejected
        // before any work where the boxes show it.
        const double gap = box.exteriorDistance(box_b);
        result.status = check_distance(tolerance, planned.budget.bound + far_rounding * gap, gap);
    }
    return result.status.ok();
}

/// Side of a field's tiles in cells, without the halo.
std::uint32_t side_of_tiles(const PlannedQuery& planned, bool at_points, const PlanLimits& limits) {
    if (planned.technique == Technique::cpu) {
        return UINT32_MAX;  // the whole grid
    }
    const FieldParts& parts = planned.field().parts;
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
bool check_resident(const DistanceFieldQuery& query, const Grid& grid, std::uint32_t largest_image,
                    const PlannedQuery& planned, const Box& box_b, PlannedField& field,
                    DistanceFieldResult& result) {
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
    result.status = check_distance(
        result.tolerance, planned.budget.bound + far_rounding * field.farthest, field.farthest);
    return result.status.ok();
}

/// Assigns the points of a field to the tiles that it will be cut into.
Status add_points(const DistanceFieldQuery& query, const Grid& grid, std::uint32_t side,
                  bool on_cpu, PlannedField& field, Plan& plan) {
    // A rectangle is a whole number of cells only up to rounding.
    constexpr double slack = 1e-6;
    const std::uint32_t halo = field.parts.halo;
    const std::uint64_t tiles_along = (grid.width + side - 1) / side;
    const auto width = static_cast<double>(grid.width);
    const auto height = static_cast<double>(grid.height);
    const std::size_t first = plan.field_points.size();
    const auto first_tile = static_cast<std::uint32_t>(plan.tiles.size());
    for (std::size_t i = 0; i < query.points.size(); ++i) {
        const Vector position = geometry::to_vector(query.points[i]);
        const Vector local = (position - grid.origin) / grid.cell;
        if (!(local.minCoeff() >= -slack && local.x() <= width + slack &&
              local.y() <= height + slack)) {
            plan.field_points.resize(first);
            const Vector high = grid.origin + grid.cell * Vector(width, height);
            return {StatusCode::invalid_query,
                    "point " + std::to_string(i) + " " + place(position) +
                        " is outside the grid of the field, which covers " + place(grid.origin) +
                        " to " + place(high)};
        }
        // The cell that contains the point determines the tile; the halo holds the neighbouring
        // cells.
        const auto cell = [](double coordinate, std::uint64_t count) {
            const double last = static_cast<double>(count - 1);
            return static_cast<std::uint64_t>(std::clamp(std::floor(coordinate), 0.0, last));
        };
        const std::uint64_t column = cell(local.x(), grid.width);
        const std::uint64_t row = cell(local.y(), grid.height);
        const bool to_the_left = local.x() < static_cast<double>(column) + 0.5;
        const bool below = local.y() < static_cast<double>(row) + 0.5;
        PlannedFieldPoint& point = plan.field_points.emplace_back();
        point.position = position;
        point.tile =
            on_cpu
                ? PlannedFieldPoint::no_tile
                : first_tile + static_cast<std::uint32_t>(row / side * tiles_along + column / side);
        point.column = static_cast<std::uint32_t>(column % side) + halo - (to_the_left ? 1U : 0U);
        point.row = static_cast<std::uint32_t>(row % side) + halo - (below ? 1U : 0U);
        point.across = local.x() - static_cast<double>(column) + (to_the_left ? 0.5 : -0.5);
        point.up = local.y() - static_cast<double>(row) + (below ? 0.5 : -0.5);
    }
    field.first_point = static_cast<std::uint32_t>(first);
    field.point_count = static_cast<std::uint32_t>(query.points.size());
    return {};
}

}  // namespace

void FieldPlanner::plan(const DistanceFieldQuery& query, CurrentQuery& current,
                        DistanceFieldResult& result) {
    const PlanLimits& limits = current.limits;
    PlannedQuery& planned = current.planned();
    planned.budget = field_budget(query, limits.subpixel, planned.deviations);
    result.error_bound = planned.budget.bound;
    result.cell = planned.budget.cell;
    const std::optional<Box> box = box_of(query, planned, result);
    if (!box) {
        return;
    }
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const Box box_b = b.box();
    if (!check_numbers(planned, *box, b, box_b, result)) {
        return;
    }
    regions_.cover(*box, result);
    const Grid& grid = regions_.grids().front();
    auto& field = planned.work.emplace<PlannedField>();
    field.parts = field_parts(query);
    if (planned.on_device &&
        !check_resident(query, grid, limits.largest_image, planned, box_b, field, result)) {
        return;
    }
    const bool on_cpu = planned.technique == Technique::cpu;
    if (on_cpu) {
        regions_.require_sides(current.index, query.tolerance);
    }
    const std::uint32_t side = side_of_tiles(planned, !query.points.empty(), limits);
    current.memory.require(
        bytes_of_cells(query, field.parts, grid, side) + bytes_of_points(query, field.parts) +
            (planned.technique == Technique::compute && (field.parts.values || field.parts.features)
                 ? regions_.bytes_of_masks(1, limits.largest_tile) +
                       bytes_of_field_lists(grid.cells())
                 : 0.0),
        2.0);
    const auto first_tile = static_cast<std::uint32_t>(current.plan.tiles.size());
    result.status = add_points(query, grid, side, on_cpu, field, current.plan);
    if (!result.status.ok()) {
        return;
    }
    make_room(query, grid, field.parts, result);
    if (on_cpu) {
        return;
    }
    regions_.cut_into_tiles(current.index, TileKind::field, side, field.parts.halo,
                            current.plan.tiles);
    if (!field.parts.values && !field.parts.features) {
        drop_tiles_without_points(first_tile, field, current.plan);
    }
}

void FieldPlanner::drop_tiles_without_points(std::uint32_t first_tile, const PlannedField& field,
                                             Plan& plan) {
    const std::span points(plan.field_points.data() + field.first_point, field.point_count);
    kept_tiles_.assign(plan.tiles.size() - first_tile, 0);
    for (const PlannedFieldPoint& point : points) {
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
    for (PlannedFieldPoint& point : points) {
        point.tile = kept_tiles_[point.tile - first_tile];
    }
}

}  // namespace nearfield::plan
