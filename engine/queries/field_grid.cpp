#include <engine/geometry/magnitude.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/field_grid.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace nearfield::queries {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;
using geometry::Vector;

std::string place(const Vector& point) {
    return "(" + geometry::number(point.x()) + ", " + geometry::number(point.y()) + ")";
}

/// The box that a field covers; empty if there is none, and then the result states why.
std::optional<Box> box_of(const DistanceFieldQuery& asked, const CheckedQuery& query,
                          ResultSummary& result) {
    if (asked.rectangle) {
        return Box(geometry::to_vector(asked.rectangle->min),
                   geometry::to_vector(asked.rectangle->max));
    }
    const Box box_a = TransformedPolygon(*query.a, query.pose_a).box();
    const Box box = box_a.intersection(TransformedPolygon(*query.b, query.pose_b).box());
    if (box.isEmpty()) {
        result.status = {StatusCode::invalid_query,
                         "the bounding boxes of A and B have nothing in common; give the "
                         "rectangle the distance field is to cover"};
        return std::nullopt;
    }
    return geometry::grown(box, asked.tolerance);
}

/// Checks that tolerance and deviations are compatible with coordinates and distances this large;
/// the result states the error.
bool check_numbers(const CheckedQuery& query, const Box& box, const TransformedPolygon& b,
                   const Box& box_b, ResultSummary& result) {
    const double tolerance = result.tolerance;
    result.status = check_deviations(tolerance, query.deviations, query.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            tolerance, std::max(geometry::largest_magnitude(box),
                                geometry::largest_magnitude(b, query.pose_b, box_b)));
    }
    if (result.status.ok()) {
        // No cell is nearer to B than the boxes are to each other: a field too far away is rejected
        // before any work where the boxes show it.
        const double gap = box.exteriorDistance(box_b);
        result.status = check_distance(tolerance, query.budget.bound + far_rounding * gap, gap);
    }
    return result.status.ok();
}

}  // namespace

std::optional<Grid> grid_of_field(const CheckedQuery& query, DistanceFieldResult& result) {
    const auto& asked = std::get<DistanceFieldQuery>(*query.query);
    const std::optional<Box> box = box_of(asked, query, result);
    if (!box) {
        return std::nullopt;
    }
    const TransformedPolygon b(*query.b, query.pose_b);
    if (!check_numbers(query, *box, b, b.box(), result)) {
        return std::nullopt;
    }
    const Grid grid = Grid::covering(*box, result.cell);
    result.regions.push_back(region_of(grid));
    return grid;
}

double bytes_of_field(const DistanceFieldQuery& query, const FieldParts& parts, const Grid& grid,
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
    const double words_of_points = parts.words_per_point * sizeof(std::uint32_t);
    const double points = static_cast<double>(query.points.size()) *
                          (sizeof(FieldPoint) + sizeof(PlacedFieldPoint) +
                           2.0 * sizeof(shaders::TilePointData) + words_of_points);
    return points + result * grid.cells() + bytes_of_tile * tiles +
           (words * sizeof(std::uint32_t) + signs) * drawn(grid.width) * drawn(grid.height);
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

Status place_points(const DistanceFieldQuery& query, const FieldParts& parts, const Grid& grid,
                    const FieldCut& cut, std::vector<PlacedFieldPoint>& points) {
    // A rectangle is a whole number of cells only up to rounding.
    constexpr double slack = 1e-6;
    const std::uint32_t halo = parts.halo;
    const std::uint64_t tiles_along = (grid.width + cut.side - 1) / cut.side;
    const auto width = static_cast<double>(grid.width);
    const auto height = static_cast<double>(grid.height);
    const std::size_t first = points.size();
    for (std::size_t i = 0; i < query.points.size(); ++i) {
        const Vector position = geometry::to_vector(query.points[i]);
        const Vector local = (position - grid.origin) / grid.cell;
        if (!(local.minCoeff() >= -slack && local.x() <= width + slack &&
              local.y() <= height + slack)) {
            points.resize(first);
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
        PlacedFieldPoint& point = points.emplace_back();
        point.position = position;
        point.tile = cut.first_tile +
                     static_cast<std::uint32_t>(row / cut.side * tiles_along + column / cut.side);
        point.column =
            static_cast<std::uint32_t>(column % cut.side) + halo - (to_the_left ? 1U : 0U);
        point.row = static_cast<std::uint32_t>(row % cut.side) + halo - (below ? 1U : 0U);
        point.across = local.x() - static_cast<double>(column) + (to_the_left ? 0.5 : -0.5);
        point.up = local.y() - static_cast<double>(row) + (below ? 0.5 : -0.5);
    }
    return {};
}

void refuse_field(Status status, DistanceFieldResult& result) {
    clear_cells(result);
    result.points.clear();
    result.status = std::move(status);
}

bool state_bounds(const DistanceFieldQuery& query, float largest, DistanceFieldResult& result) {
    // Far from B, a single-precision float is coarser than the rest of the bound.
    const auto farthest = static_cast<double>(largest);
    result.error_bound += far_rounding * farthest;
    if (query.gradients || !query.points.empty()) {
        const bool exact = query.gradient == GradientMethod::analytic;
        // Two values, each off by up to the bound, two cells apart.
        result.gradient_error_bound = exact ? 1e-6 : result.error_bound / result.cell;
    }
    if (Status status = check_distance(result.tolerance, result.error_bound, farthest);
        !status.ok()) {
        refuse_field(std::move(status), result);
        return false;
    }
    return true;
}

}  // namespace nearfield::queries
