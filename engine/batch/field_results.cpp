#include <engine/base/interruption.hpp>
#include <engine/batch/field_results.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/field_grid.hpp>
#include <engine/queries/query_timer.hpp>
#include <engine/solvers/field_features.hpp>
#include <engine/solvers/field_reconstruction.hpp>
#include <engine/solvers/nearest_feature.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nearfield::batch {
namespace {

using device_input::PlannedTile;
using geometry::TransformedPolygon;
using geometry::Vector;

float from_word(std::uint32_t word) {
    return std::bit_cast<float>(word);
}

/// Calls `visit` for every cell of a tile outside its halo, with the cell's index among the drawn
/// cells and its index in the arrays of a result.
template <class Visit>
void for_cells(const PlannedTile& tile, std::size_t result_width, Visit&& visit) {
    for (std::size_t row = tile.halo; row + tile.halo < tile.height; ++row) {
        for (std::size_t column = tile.halo; column + tile.halo < tile.width; ++column) {
            visit(row * tile.width + column,
                  (tile.row + row - tile.halo) * result_width + tile.column + column - tile.halo);
        }
    }
}

/// Relative error of one rounding in the format of blended gradients; a driver may truncate instead
/// of rounding.
double blending_precision(const std::string& format) {
    return std::ldexp(1.0, format == "R16G16_SFLOAT" ? -10 : -23);
}

}  // namespace

float FieldDecoder::in_world(std::uint32_t word, const PlannedTile& tile) {
    const float value = from_word(word) * static_cast<float>(tile.grid.cell);
    largest_[tile.query] = std::max(largest_[tile.query], std::abs(value));
    return value;
}

void FieldDecoder::add(const device_input::Plan& plan, const device_input::TileBatch& batch,
                       std::span<const std::uint32_t> words, std::vector<AnyResult>& results) {
    for (const device_input::FieldTile& field : batch.field_tiles) {
        checkpoint();
        const PlannedTile& tile = plan.tiles[batch.tile_index[field.tile]];
        const queries::QueryTimer timer(plan.times, tile.query, &QueryTime::answer);
        add_tile(plan.queries[tile.query], tile, field, words,
                 std::get<DistanceFieldResult>(results[tile.query]));
    }
    for (const device_input::FieldPointRun& run : batch.field_point_runs) {
        const device_input::PlannedQuery& planned = plan.queries[run.query];
        auto& result = std::get<DistanceFieldResult>(results[run.query]);
        const queries::QueryTimer timer(plan.times, run.query, &QueryTime::answer);
        SparseCheckpoint<256> checkpoint;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            checkpoint.step();
            const std::uint32_t index = batch.field_point_index[run.first + i];
            const queries::PlacedFieldPoint& point = plan.field_points[index];
            const std::uint32_t count = run.parts.words_per_point;
            add_point(planned, plan.tiles[point.tile], point,
                      words.subspan(run.first_word + std::size_t{i} * count, count),
                      result.points[index - planned.field().first_point]);
        }
    }
}

void FieldDecoder::add_tile(const device_input::PlannedQuery& planned, const PlannedTile& tile,
                            const device_input::FieldTile& field,
                            std::span<const std::uint32_t> words, DistanceFieldResult& result) {
    const auto& query = std::get<DistanceFieldQuery>(*planned.query);
    if (planned.field().parts.host_values) {
        add_values(tile, words.subspan(field.first_value), query.values, result);
    }
    if (planned.field().parts.host_features) {
        add_features(planned, tile, words.subspan(field.first_feature), result);
    }
    if (planned.field().parts.gradients) {
        const auto gradients = words.subspan(field.first_gradient);
        for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
            result.gradients[2 * cell] = from_word(gradients[2 * drawn]);
            result.gradients[2 * cell + 1] = from_word(gradients[2 * drawn + 1]);
        });
    } else if (query.gradients && query.gradient == GradientMethod::central_differences) {
        const auto values = words.subspan(field.first_value);
        const auto half_difference = [&](std::size_t high, std::size_t low) {
            return 0.5F * (from_word(values[high]) - from_word(values[low]));
        };
        for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
            result.gradients[2 * cell] = half_difference(drawn + 1, drawn - 1);
            result.gradients[2 * cell + 1] =
                half_difference(drawn + tile.width, drawn - tile.width);
        });
    }
}

void FieldDecoder::add_values(const PlannedTile& tile, std::span<const std::uint32_t> words,
                              bool keep, DistanceFieldResult& result) {
    const auto cell = static_cast<float>(tile.grid.cell);
    const std::size_t halo = tile.halo;
    const std::size_t count = tile.width - 2 * halo;
    // Compared as integers without their signs, which have the same order: this lets the loop below
    // vectorise.
    std::int32_t largest = 0;
    for (std::size_t row = halo; row + halo < tile.height; ++row) {
        const std::uint32_t* drawn = words.data() + row * tile.width + halo;
        for (std::size_t i = 0; i < count; ++i) {
            largest = std::max(largest, static_cast<std::int32_t>(drawn[i] & 0x7fffffffU));
        }
        if (keep) {
            float* values =
                result.values.data() + (tile.row + row - halo) * result.width + tile.column;
            for (std::size_t i = 0; i < count; ++i) {
                values[i] = from_word(drawn[i]) * cell;
            }
        }
    }
    largest_[tile.query] =
        std::max(largest_[tile.query], from_word(static_cast<std::uint32_t>(largest)) * cell);
}

void FieldDecoder::add_features(const device_input::PlannedQuery& planned, const PlannedTile& tile,
                                std::span<const std::uint32_t> words, DistanceFieldResult& result) {
    const auto& query = std::get<DistanceFieldQuery>(*planned.query);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double touching = solvers::touching_distance(tile);
    for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
        solvers::write_feature(query, b, touching, cell, words[drawn], result);
    });
}

void FieldDecoder::add_point(const device_input::PlannedQuery& planned, const PlannedTile& tile,
                             const queries::PlacedFieldPoint& point,
                             std::span<const std::uint32_t> words, FieldPoint& result) {
    const auto cells = words.subspan(1);
    solvers::CellsAround around;
    double farthest = 0.0;
    for (std::size_t i = 0; i < around.distances.size(); ++i) {
        around.distances[i] = static_cast<double>(in_world(cells[i], tile));
        around.inside[i] = std::signbit(from_word(cells[i]));
        farthest = std::max(farthest, std::abs(around.distances[i]));
    }
    const double error = planned.budget.bound + queries::far_rounding * farthest;
    const TransformedPolygon b(*planned.b, planned.pose_b);
    reconstruct(
        point, around, tile.grid.cell, error,
        solvers::field_feature(b, solvers::touching_distance(tile), point.position, words[0]),
        result);
    if (planned.field().parts.blended) {
        result.gradient = solvers::gradient_between(point, [&](std::size_t i) {
            return Vector(from_word(cells[4 + 2 * i]), from_word(cells[5 + 2 * i]));
        });
    } else if (planned.field().parts.cells_per_point > 4) {
        result.gradient = solvers::difference_between(
            point, [&](std::size_t i) { return static_cast<double>(from_word(cells[i])); });
    }
}

void FieldDecoder::refuse(const device_input::Plan& plan, const device_input::TileBatch& batch) {
    for (const device_input::FieldTile& field : batch.field_tiles) {
        refused_.push_back(plan.tiles[batch.tile_index[field.tile]].query);
    }
}

void FieldDecoder::finish(const device_input::PlannedQuery& planned,
                          DistanceFieldResult& result) const {
    if (std::find(refused_.begin(), refused_.end(), planned.index) != refused_.end()) {
        queries::refuse_field(
            {StatusCode::too_large,
             "more edges are about equally near to a cell of the distance field than "
             "technique compute compares; ask for another technique"},
            result);
        return;
    }
    const float largest = largest_[planned.index];
    if (!queries::state_bounds(std::get<DistanceFieldQuery>(*planned.query), largest, result) ||
        !planned.field().parts.blended) {
        return;
    }
    result.gradient_format = gradient_format_;
    // Half of the errors: two values and their difference are rounded; then the product.
    // Differences reach up to two cells beyond the grid.
    const auto farthest = static_cast<double>(largest);
    const double precision = blending_precision(gradient_format_);
    result.gradient_error_bound += precision * (farthest / result.cell + 5.0);
    if (!(result.gradient_error_bound < 1.0)) {
        queries::refuse_field(
            {StatusCode::invalid_query,
             "the field reaches to a distance of " + geometry::number(farthest) +
                 " from B, where a blended gradient in the format " +
                 std::string(gradient_format_) + " is off by up to " +
                 geometry::number(result.gradient_error_bound) +
                 "; take analytic or central_differences, or a rectangle nearer to B"},
            result);
    }
}

}  // namespace nearfield::batch
