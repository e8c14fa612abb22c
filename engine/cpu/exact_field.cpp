#include <engine/base/interruption.hpp>
#include <engine/cpu/exact_field.hpp>
#include <engine/plan/tile_edges.hpp>
#include <engine/records/field_features.hpp>
#include <engine/records/field_reconstruction.hpp>
#include <engine/records/nearest_feature.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nearfield::cpu {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;
using plan::PlannedQuery;

// Cell words are the same as on the device.
static_assert(grid::nearest_inside == plan::point_inside);
static_assert(grid::FieldSolver::relative_rounding == plan::far_rounding);
static_assert(grid::nearest_unique == plan::point_unique);

double touching_at(const DistanceFieldResult& result) {
    return records::touching_distance(result.cell, 0);
}

}  // namespace

double ExactField::answer(const plan::Plan& plan, const PlannedQuery& planned,
                          plan::SimplifiedShapes& shapes, DistanceFieldResult& result) {
    double largest = 0.0;
    if (planned.field().parts.values || planned.field().parts.features) {
        largest = solve_cells(planned, shapes, result);
    }
    if (planned.field().point_count > 0) {
        largest = std::max(largest, solve_points(plan, planned, result));
    }
    return largest;
}

double ExactField::solve_cells(const PlannedQuery& planned, plan::SimplifiedShapes& shapes,
                               DistanceFieldResult& result) {
    const auto& query = std::get<DistanceFieldQuery>(*planned.query);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double cell = result.cell;
    grid::FieldGrid grid{geometry::to_vector(result.origin), cell, result.width, result.height};
    grid::FieldOutput output{result.values, {}, cell, plan::margin_in_cells};
    const bool differences =
        query.gradients && query.gradient == GradientMethod::central_differences;
    if (differences) {
        grid.origin.array() -= cell;
        grid.width += 2;
        grid.height += 2;
        distances_.resize(std::size_t{grid.width} * grid.height);
        output.distances = distances_;
        output.scale = 1.0;
    }
    if (planned.field().parts.features) {
        words_.resize(std::size_t{grid.width} * grid.height);
        output.nearest = words_;
    }
    std::span<const geometry::SimplifiedEdge> edges;
    if (const double most = planned.budget.simplification; most > 0.0) {
        edges = shapes.get(*planned.b, most, plan::longest_tile_run * cell).edges;
        double deviation = 0.0;
        for (const geometry::SimplifiedEdge& edge : edges) {
            deviation = std::max(deviation, edge.deviation);
        }
        result.error_bound -= most - deviation;
    }
    const double largest = solver_.solve(b, edges, grid, output);
    if (planned.field().parts.features) {
        write_features(query, b, differences ? 1 : 0, result);
    }
    if (!differences) {
        return largest;
    }
    take_differences(query, result);
    return largest * cell;
}

void ExactField::write_features(const DistanceFieldQuery& query, const TransformedPolygon& b,
                                std::size_t border, DistanceFieldResult& result) const {
    const std::size_t stride = result.width + 2 * border;
    for (std::size_t row = 0; row < result.height; ++row) {
        checkpoint();
        for (std::size_t column = 0; column < result.width; ++column) {
            records::write_feature(query, b, touching_at(result), row * result.width + column,
                                   words_[(row + border) * stride + column + border], result);
        }
    }
}

void ExactField::take_differences(const DistanceFieldQuery& query,
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

double ExactField::solve_points(const plan::Plan& plan, const PlannedQuery& planned,
                                DistanceFieldResult& result) {
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const Vector origin = geometry::to_vector(result.origin);
    const double cell = result.cell;
    const bool differences = planned.field().parts.cells_per_point > 4;
    boundary_.set(b);
    // Points are resolved on the boundary itself, so simplification adds no error.
    const double error = planned.budget.bound - planned.budget.simplification;
    double largest = 0.0;
    narrowphase::NearestPoint guess;
    const auto signed_distance = [&](const Vector& place) {
        guess = boundary_.nearest(place, guess.edge);
        const double distance = std::sqrt(guess.on_edge.squared_distance);
        return boundary_.contains(place) ? -distance : distance;
    };
    for (std::uint32_t i = 0; i < planned.field().point_count; ++i) {
        checkpoint();
        const plan::PlannedFieldPoint& point = plan.field_points[planned.field().first_point + i];
        std::array<double, records::difference_cells.size()> distances{};
        const std::size_t count = planned.field().parts.cells_per_point;
        for (std::size_t k = 0; k < count; ++k) {
            const Vector place(static_cast<double>(point.column) - planned.field().parts.halo +
                                   records::difference_cells[k].column + 0.5,
                               static_cast<double>(point.row) - planned.field().parts.halo +
                                   records::difference_cells[k].row + 0.5);
            distances[k] = signed_distance(origin + cell * place);
            largest = std::max(largest, std::abs(distances[k]));
        }
        records::CellsAround around;
        for (std::size_t k = 0; k < around.distances.size(); ++k) {
            around.distances[k] = distances[k];
            around.inside[k] = std::signbit(distances[k]);
        }
        const std::uint32_t word = word_at(point.position, guess.edge, cell);
        FieldPoint& found = result.points[i];
        reconstruct(point, around, cell, error,
                    records::field_feature(b, touching_at(result), point.position, word), found);
        if (differences) {
            found.gradient = records::difference_between(
                point, [&](std::size_t k) { return distances[k] / cell; });
        }
    }
    return largest;
}

std::uint32_t ExactField::word_at(const Vector& point, std::uint32_t guess, double cell) {
    const narrowphase::NearestPoint nearest = boundary_.nearest(point, guess);
    const double distance = std::sqrt(nearest.on_edge.squared_distance);
    const double margin = std::max(plan::margin_in_cells * cell, std::ldexp(distance, -18));
    return nearest.edge | (boundary_.contains(point) ? plan::point_inside : 0U) |
           (boundary_.is_unique(point, nearest, margin) ? plan::point_unique : 0U);
}

}  // namespace nearfield::cpu
