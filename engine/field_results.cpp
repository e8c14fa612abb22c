#include <engine/field_results.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/plan/check_query.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace nearfield {
namespace {

using geometry::PlacedPolygon;
using geometry::Vector;
using plan::Tile;

/// What the word of a cell or a point stands for.
struct NearestFeature {
    Feature feature;
    Vector gradient;
    bool unique = true;
};

/// The unit normal of an edge that points outside at a place of it; zero for an edge of no length.
Vector outward_normal(const PlacedPolygon& b, std::uint32_t edge, const Vector& place,
                      double step) {
    const Vector along = b.vertex(b.polygon().next(edge)) - b.vertex(edge);
    const double length = along.norm();
    if (length == 0.0) {
        return Vector::Zero();
    }
    const Vector normal(-along.y() / length, along.x() / length);
    return geometry::contains(b, place + step * normal) ? Vector(-normal) : normal;
}

NearestFeature decode(const PlacedPolygon& b, const Tile& tile, const Vector& point,
                      std::uint32_t word) {
    const std::uint32_t edge = word & plan::point_edge_mask;
    const auto nearest = nearest_on_edge(b, edge, point);
    NearestFeature result;
    result.feature = feature_at(b, edge, nearest.parameter);
    result.unique = (word & plan::point_unique) != 0;
    const Vector away = point - nearest.point;
    const double distance = std::sqrt(nearest.squared_distance);
    const double touching = touching_distance(tile);
    if (distance > touching) {
        const bool inside = (word & plan::point_inside) != 0;
        result.gradient = (inside ? -1.0 : 1.0) / distance * away;
    } else {
        // On the boundary the way from the nearest point says nothing, but the wall does.
        result.gradient = outward_normal(b, edge, nearest.point, 2.0 * touching);
        result.unique = result.unique && !result.gradient.isZero();
    }
    return result;
}

float from_word(std::uint32_t word) {
    return std::bit_cast<float>(word);
}

/// Calls `visit` with the place of every cell that a tile stands for, its halo left out: among the
/// cells drawn, and in the arrays of a result.
template <class Visit>
void for_cells(const Tile& tile, std::size_t result_width, Visit&& visit) {
    for (std::size_t row = tile.halo; row + tile.halo < tile.height; ++row) {
        for (std::size_t column = tile.halo; column + tile.halo < tile.width; ++column) {
            visit(row * tile.width + column,
                  (tile.row + row - tile.halo) * result_width + tile.column + column - tile.halo);
        }
    }
}

/// Of four cells: low left, low right, high left, high right.
struct Bilinear {
    std::array<double, 4> weights{};

    Bilinear(double across, double up)
        : weights{(1.0 - across) * (1.0 - up), across * (1.0 - up), (1.0 - across) * up,
                  across * up} {}

    template <class Value>
    [[nodiscard]] auto operator()(Value&& value) const -> decltype(value(0)) {
        return weights[0] * value(0) + weights[1] * value(1) + weights[2] * value(2) +
               weights[3] * value(3);
    }
};

/// How far the truth may be from a reconstructed distance. It differs from each cell's distance by
/// no more than the way there and that cell's own error, so it lies between two limits.
double reconstruction_error(const std::array<double, 4>& values, double distance, double cell_error,
                            const plan::PlannedFieldPoint& point, double cell) {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t right = i % 2;
        const std::size_t above = i / 2;
        const double x = point.across - static_cast<double>(right);
        const double y = point.up - static_cast<double>(above);
        const double reach = cell * std::hypot(x, y) + cell_error;
        low = std::max(low, values[i] - reach);
        high = std::min(high, values[i] + reach);
    }
    return std::max(high - distance, distance - low);
}

/// Central differences at the four cells around a point, from the twelve cells that
/// resolve_field_points.comp lists.
Vector difference_at(std::span<const std::uint32_t> values, std::size_t corner) {
    // By corner: the neighbours to the left, to the right, below and above.
    constexpr std::array<std::array<std::size_t, 4>, 4> neighbours{
        {{4, 1, 8, 2}, {0, 5, 9, 3}, {6, 3, 0, 10}, {2, 7, 1, 11}}};
    const auto value = [&](std::size_t side) {
        return static_cast<double>(from_word(values[neighbours[corner][side]]));
    };
    return {(value(1) - value(0)) / 2.0, (value(3) - value(2)) / 2.0};
}

/// Single precision at a distance.
double rounding_at(double distance) {
    return std::ldexp(distance, -21);
}

/// What one rounding in the format of blended gradients may change of a number, in parts of it; a
/// driver may cut digits off where it could round.
double blending_precision(const std::string& format) {
    return std::ldexp(1.0, format == "R16G16_SFLOAT" ? -10 : -23);
}

}  // namespace

float FieldDecoder::in_world(std::uint32_t word, const Tile& tile) {
    const float value = from_word(word) * static_cast<float>(tile.grid.cell);
    largest_[tile.query] = std::max(largest_[tile.query], std::abs(value));
    return value;
}

void FieldDecoder::add(const plan::Plan& plan, const plan::Round& round,
                       std::span<const std::uint32_t> words, std::vector<AnyResult>& results) {
    for (const plan::TileDraw& draw : round.distance_draws) {
        if (draw.field) {
            const Tile& tile = plan.tiles[round.tile_index[draw.tile]];
            add_tile(plan.queries[tile.query], tile, draw, words,
                     std::get<DistanceFieldResult>(results[tile.query]));
        }
    }
    for (const plan::FieldPointRun& run : round.field_point_runs) {
        const plan::PlannedQuery& planned = plan.queries[run.query];
        auto& result = std::get<DistanceFieldResult>(results[run.query]);
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const std::uint32_t index = round.field_point_index[run.first + i];
            const plan::PlannedFieldPoint& point = plan.field_points[index];
            const std::uint32_t count = run.parts.words_per_point;
            add_point(planned, plan.tiles[point.tile], point,
                      words.subspan(run.first_word + std::size_t{i} * count, count),
                      result.points[index - planned.first_field_point]);
        }
    }
}

void FieldDecoder::add_tile(const plan::PlannedQuery& planned, const Tile& tile,
                            const plan::TileDraw& draw, std::span<const std::uint32_t> words,
                            DistanceFieldResult& result) {
    const auto& query = std::get<DistanceFieldQuery>(*planned.query);
    if (planned.field.values) {
        const auto values = words.subspan(draw.first_value);
        for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
            const float distance = in_world(values[drawn], tile);
            if (query.values) {
                result.values[cell] = distance;
            }
        });
    }
    if (planned.field.features) {
        add_features(planned, tile, words.subspan(draw.first_feature), result);
    }
    if (planned.field.gradients) {
        const auto gradients = words.subspan(draw.first_gradient);
        for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
            result.gradients[2 * cell] = from_word(gradients[2 * drawn]);
            result.gradients[2 * cell + 1] = from_word(gradients[2 * drawn + 1]);
        });
    } else if (query.gradients && query.gradient == GradientMethod::central_differences) {
        const auto values = words.subspan(draw.first_value);
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

void FieldDecoder::add_features(const plan::PlannedQuery& planned, const Tile& tile,
                                std::span<const std::uint32_t> words, DistanceFieldResult& result) {
    const auto& query = std::get<DistanceFieldQuery>(*planned.query);
    const PlacedPolygon b(*planned.b, planned.pose_b);
    const bool gradients = query.gradients && query.gradient == GradientMethod::analytic;
    for_cells(tile, result.width, [&](std::size_t drawn, std::size_t cell) {
        const std::size_t column = cell % result.width;
        const std::size_t row = cell / result.width;
        const Vector center(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const NearestFeature nearest =
            decode(b, tile, tile.grid.origin + tile.grid.cell * center, words[drawn]);
        result.unique[cell] = nearest.unique ? 1 : 0;
        if (query.features) {
            result.features[cell] = nearest.feature;
        }
        if (gradients) {
            result.gradients[2 * cell] = static_cast<float>(nearest.gradient.x());
            result.gradients[2 * cell + 1] = static_cast<float>(nearest.gradient.y());
        }
    });
}

void FieldDecoder::add_point(const plan::PlannedQuery& planned, const Tile& tile,
                             const plan::PlannedFieldPoint& point,
                             std::span<const std::uint32_t> words, FieldPoint& result) {
    const PlacedPolygon b(*planned.b, planned.pose_b);
    const NearestFeature nearest = decode(b, tile, point.position, words[0]);
    const auto cells = words.subspan(1);
    std::array<double, 4> values{};
    std::array<double, 4> signs{};
    double farthest = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<double>(in_world(cells[i], tile));
        signs[i] = std::signbit(from_word(cells[i])) ? 1.0 : 0.0;
        farthest = std::max(farthest, std::abs(values[i]));
    }
    const Bilinear bilinear(point.across, point.up);
    result.point = geometry::to_public(point.position);
    result.distance = bilinear([&](std::size_t i) { return values[i]; });
    result.inside = bilinear([&](std::size_t i) { return signs[i]; });
    result.error_bound =
        reconstruction_error(values, result.distance, planned.budget.bound + rounding_at(farthest),
                             point, tile.grid.cell);
    result.feature = nearest.feature;
    result.unique = nearest.unique;
    Vector gradient = nearest.gradient;
    if (planned.field.blended) {
        gradient = bilinear([&](std::size_t i) {
            return Vector(from_word(cells[4 + 2 * i]), from_word(cells[5 + 2 * i]));
        });
    } else if (planned.field.cells_per_point > 4) {
        gradient = bilinear([&](std::size_t i) { return difference_at(cells, i); });
    }
    result.gradient = geometry::to_public(gradient);
}

void FieldDecoder::finish(const plan::PlannedQuery& planned, std::uint32_t query,
                          DistanceFieldResult& result) const {
    const auto& asked = std::get<DistanceFieldQuery>(*planned.query);
    // Far from B a float of single precision is coarser than the rest of the bound.
    const auto largest = static_cast<double>(largest_[query]);
    result.error_bound += rounding_at(largest);
    const bool exact = asked.gradient == GradientMethod::analytic;
    if (asked.gradients || !asked.points.empty()) {
        // Two values that are each off by the bound, two cells apart.
        result.gradient_error_bound = exact ? 1e-6 : result.error_bound / result.cell;
    }
    const auto refuse = [&](const std::string& why) {
        result.values.clear();
        result.features.clear();
        result.gradients.clear();
        result.unique.clear();
        result.points.clear();
        result.status = {StatusCode::invalid_query, "the field reaches to a distance of " +
                                                        plan::number(largest) + " from B, where " +
                                                        why};
    };
    if (!(result.error_bound <= result.tolerance)) {
        refuse("single precision cannot tell apart what differs by the tolerance " +
               plan::number(result.tolerance) +
               "; take a rectangle nearer to B or a larger tolerance");
        return;
    }
    if (planned.field.blended) {
        result.gradient_format = gradient_format_;
        // Half of: two values and their difference rounded; then the product. Differences look up
        // to two cells beyond the grid.
        const double precision = blending_precision(gradient_format_);
        result.gradient_error_bound += precision * (largest / result.cell + 5.0);
        if (!(result.gradient_error_bound < 1.0)) {
            refuse("a blended gradient in the format " + std::string(gradient_format_) +
                   " is off by up to " + plan::number(result.gradient_error_bound) +
                   "; take analytic or central_differences, or a rectangle nearer to B");
        }
    }
}

}  // namespace nearfield
