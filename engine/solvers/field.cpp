#include <engine/base/interruption.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/queries/tile_edges.hpp>
#include <engine/solvers/field.hpp>
#include <engine/solvers/field_features.hpp>
#include <engine/solvers/field_reconstruction.hpp>
#include <engine/solvers/nearest_feature.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nearfield::solvers {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

// Cell words are the same as on the device.
static_assert(nearest_inside == shaders::point_inside);
static_assert(CellSolver::relative_rounding == queries::far_rounding);
static_assert(nearest_unique == shaders::point_unique);

/// The CPU cuts a grid into no tiles.
constexpr double whole_grid = UINT32_MAX;

double touching_at(const DistanceFieldResult& result) {
    return touching_distance(result.cell, 0);
}

}  // namespace

void FieldSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                         DistanceFieldResult& result) {
    answer(query, workspace, *workspace.memory, result);
    if (result.status.ok() && query.a != nullptr) {
        result.intersects = intersect(query, workspace.instances, overlap_test_);
    }
}

void FieldSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                         queries::MemoryBudget& memory, DistanceFieldResult& result) {
    const auto& asked = std::get<DistanceFieldQuery>(*query.query);
    const std::optional<queries::Grid> grid = queries::grid_of_field(query, result);
    if (!grid) {
        queries::clear_cells(result);
        return;
    }
    parts_ = queries::field_parts(asked);
    regions_.set(*grid);
    regions_.require_sides(query.index, asked.tolerance);
    queries::QueryMemory(memory, query.index, asked.tolerance)
        .require(queries::bytes_of_field(asked, parts_, *grid, whole_grid), 2.0);
    points_.clear();
    result.status = queries::place_points(asked, parts_, *grid, {}, points_);
    if (!result.status.ok()) {
        queries::clear_cells(result);
        return;
    }
    queries::make_room(asked, *grid, parts_, result);
    double largest = 0.0;
    if (parts_.values || parts_.features) {
        largest = solve_cells(query, workspace.simplified, result);
    }
    if (!points_.empty()) {
        largest = std::max(largest, solve_points(query, result));
    }
    static_cast<void>(queries::state_bounds(asked, static_cast<float>(largest), result));
}

double FieldSolver::solve_cells(const queries::CheckedQuery& query,
                                queries::SimplifiedShapes& shapes, DistanceFieldResult& result) {
    const auto& asked = std::get<DistanceFieldQuery>(*query.query);
    const TransformedPolygon b(*query.b, query.pose_b);
    const double cell = result.cell;
    FieldGrid grid{geometry::to_vector(result.origin), cell, result.width, result.height};
    FieldOutput output{result.values, {}, cell, queries::margin_in_cells};
    const bool differences =
        asked.gradients && asked.gradient == GradientMethod::central_differences;
    if (differences) {
        grid.origin.array() -= cell;
        grid.width += 2;
        grid.height += 2;
        distances_.resize(std::size_t{grid.width} * grid.height);
        output.distances = distances_;
        output.scale = 1.0;
    }
    if (parts_.features) {
        words_.resize(std::size_t{grid.width} * grid.height);
        output.nearest = words_;
    }
    std::span<const geometry::SimplifiedEdge> edges;
    if (const double most = query.budget.simplification; most > 0.0) {
        edges = shapes.get(*query.b, most, queries::longest_tile_run * cell).edges;
        double deviation = 0.0;
        for (const geometry::SimplifiedEdge& edge : edges) {
            deviation = std::max(deviation, edge.deviation);
        }
        result.error_bound -= most - deviation;
    }
    const double largest = solver_.solve(b, edges, grid, output);
    if (parts_.features) {
        write_features(asked, b, differences ? 1 : 0, result);
    }
    if (!differences) {
        return largest;
    }
    take_differences(asked, result);
    return largest * cell;
}

void FieldSolver::write_features(const DistanceFieldQuery& query, const TransformedPolygon& b,
                                 std::size_t border, DistanceFieldResult& result) const {
    const std::size_t stride = result.width + 2 * border;
    for (std::size_t row = 0; row < result.height; ++row) {
        checkpoint();
        for (std::size_t column = 0; column < result.width; ++column) {
            write_feature(query, b, touching_at(result), row * result.width + column,
                          words_[(row + border) * stride + column + border], result);
        }
    }
}

void FieldSolver::take_differences(const DistanceFieldQuery& query,
                                   DistanceFieldResult& result) const {
    const std::size_t stride = result.width + std::size_t{2};
    const auto scale = static_cast<float>(result.cell);
    for (std::size_t row = 0; row < result.height; ++row) {
        checkpoint();
        for (std::size_t column = 0; column < result.width; ++column) {
            const float* const centre = &distances_[(row + 1) * stride + column + 1];
            const std::size_t cell = row * result.width + column;
            if (query.values) {
                result.values[cell] = *centre * scale;
            }
            result.gradients[2 * cell] = 0.5F * (centre[1] - centre[-1]);
            result.gradients[2 * cell + 1] = 0.5F * (*(centre + stride) - *(centre - stride));
        }
    }
}

double FieldSolver::solve_points(const queries::CheckedQuery& query, DistanceFieldResult& result) {
    const TransformedPolygon b(*query.b, query.pose_b);
    const Vector origin = geometry::to_vector(result.origin);
    const double cell = result.cell;
    const bool differences = parts_.cells_per_point > 4;
    boundary_.set(b);
    // Points are resolved on the boundary itself, so simplification adds no error.
    const double error = query.budget.bound - query.budget.simplification;
    double largest = 0.0;
    narrowphase::NearestPoint guess;
    const auto signed_distance = [&](const Vector& place) {
        guess = boundary_.nearest(place, guess.edge);
        const double distance = std::sqrt(guess.on_edge.squared_distance);
        return boundary_.contains(place) ? -distance : distance;
    };
    for (std::size_t i = 0; i < points_.size(); ++i) {
        checkpoint();
        const queries::PlacedFieldPoint& point = points_[i];
        std::array<double, difference_cells.size()> distances{};
        const std::size_t count = parts_.cells_per_point;
        for (std::size_t k = 0; k < count; ++k) {
            const Vector place(
                static_cast<double>(point.column) - parts_.halo + difference_cells[k].column + 0.5,
                static_cast<double>(point.row) - parts_.halo + difference_cells[k].row + 0.5);
            distances[k] = signed_distance(origin + cell * place);
            largest = std::max(largest, std::abs(distances[k]));
        }
        CellsAround around;
        for (std::size_t k = 0; k < around.distances.size(); ++k) {
            around.distances[k] = distances[k];
            around.inside[k] = std::signbit(distances[k]);
        }
        const std::uint32_t word = word_at(point.position, guess.edge, cell);
        FieldPoint& found = result.points[i];
        reconstruct(point, around, cell, error,
                    field_feature(b, touching_at(result), point.position, word), found);
        if (differences) {
            found.gradient =
                difference_between(point, [&](std::size_t k) { return distances[k] / cell; });
        }
    }
    return largest;
}

std::uint32_t FieldSolver::word_at(const Vector& point, std::uint32_t guess, double cell) {
    const narrowphase::NearestPoint nearest = boundary_.nearest(point, guess);
    const double distance = std::sqrt(nearest.on_edge.squared_distance);
    const double margin = std::max(queries::margin_in_cells * cell, std::ldexp(distance, -18));
    return nearest.edge | (boundary_.contains(point) ? shaders::point_inside : 0U) |
           (boundary_.is_unique(point, nearest, margin) ? shaders::point_unique : 0U);
}

}  // namespace nearfield::solvers
