#include <tools/common/library_error.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/rendering/scene_picture.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace nearfield::tools {
namespace {

using simulation::operator+;

constexpr double pixels_a_cell = 4.0;

Color distance_color(double value, double reach) {
    // Bands of equal distance, an eighth of the reach wide.
    const double position = std::clamp(value / reach, -1.0, 1.0);
    return diverging_color(std::floor(8.0 * position) / 8.0 + 0.06);
}

/// Features with equal numbers have different colours on different bodies.
Color body_feature_color(std::size_t body, Feature feature) {
    feature.index += 37 * static_cast<std::uint32_t>(body);
    return feature_color(feature);
}

Color banded_direction_color(float x, float y) {
    constexpr double bands = 32.0;
    constexpr double turn = 2.0 * std::numbers::pi;
    const double angle = std::atan2(static_cast<double>(y), static_cast<double>(x));
    return direction_color(simulation::polar(1.0, turn * std::round(bands * angle / turn) / bands));
}

Batch fields_of(const simulation::Proximity& proximity, const View& view, FieldOverlay layer) {
    Batch batch;
    DistanceFieldQuery query;
    query.tolerance = pixels_a_cell / view.scale() / std::sqrt(2.0);
    query.rectangle = view.world();
    query.features = layer == FieldOverlay::features;
    query.gradients = layer == FieldOverlay::gradient;
    for (const Instance& instance : proximity.instances()) {
        query.b = instance;
        batch.add(query);
    }
    return batch;
}

}  // namespace

ColoredCells field_overlay(Context& context, simulation::World& world, const View& view,
                           FieldOverlay layer) {
    const Batch batch = fields_of(world.proximity(), view, layer);
    Results results;
    require(context.run(batch, results), "the distance field");
    std::vector<const DistanceFieldResult*> fields;
    for (std::uint32_t i = 0; i < batch.queries().size(); ++i) {
        fields.push_back(&results[QueryHandle<DistanceFieldQuery>{i}]);
        require(fields.back()->status, "the distance field");
    }
    const DistanceFieldResult& first = *fields.front();
    const Vector2 high =
        first.origin + Vector2{first.cell * first.width, first.cell * first.height};
    ColoredCells cells{
        {view.to_page(first.origin), view.to_page(high)}, first.width, first.height, {}};
    const double reach = 0.12 * (view.world().max.x - view.world().min.x);
    for (std::size_t cell = 0; cell < first.values.size(); ++cell) {
        const auto nearest =
            std::min_element(fields.begin(), fields.end(),
                             [cell](const DistanceFieldResult* a, const DistanceFieldResult* b) {
                                 return a->values[cell] < b->values[cell];
                             });
        const DistanceFieldResult& field = **nearest;
        if (layer == FieldOverlay::features) {
            const auto body = static_cast<std::size_t>(nearest - fields.begin());
            cells.colors.push_back(body_feature_color(body, field.features[cell]));
        } else if (layer == FieldOverlay::gradient) {
            cells.colors.push_back(
                banded_direction_color(field.gradients[2 * cell], field.gradients[2 * cell + 1]));
        } else {
            cells.colors.push_back(distance_color(static_cast<double>(field.values[cell]), reach));
        }
    }
    return cells;
}

}  // namespace nearfield::tools
