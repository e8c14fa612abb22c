#include <engine/queries/field_parts.hpp>

namespace nearfield::queries {

FieldParts field_parts(const DistanceFieldQuery& query) {
    const bool at_points = !query.points.empty();
    const bool differences =
        query.gradient != GradientMethod::analytic && (query.gradients || at_points);
    FieldParts parts;
    parts.blended = differences && query.gradient == GradientMethod::blended;
    parts.gradients = parts.blended && query.gradients;
    // The host computes differences from values.
    parts.host_values = query.values || parts.blended || (differences && query.gradients);
    parts.host_features =
        query.features || (query.gradients && query.gradient == GradientMethod::analytic);
    parts.values = parts.host_values || query.on_device;
    parts.features = parts.host_features || (query.on_device && query.features_on_device);
    parts.halo = (at_points ? 1U : 0U) + (differences ? 1U : 0U);
    if (differences) {
        parts.cells_per_point = parts.blended ? 4 : 12;
        parts.words_per_point = 13;
    }
    parts.small_tiles = parts.features || at_points;
    return parts;
}

}  // namespace nearfield::queries
