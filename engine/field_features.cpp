#include <engine/field_features.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/plan/gpu_layout.hpp>

#include <cmath>

namespace nearfield {
namespace {

using geometry::PlacedPolygon;
using geometry::Vector;

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

}  // namespace

FieldFeature field_feature(const PlacedPolygon& b, double touching, const Vector& point,
                           std::uint32_t word) {
    const std::uint32_t edge = word & plan::point_edge_mask;
    const auto nearest = nearest_on_edge(b, edge, point);
    FieldFeature result;
    result.feature = feature_at(b, edge, nearest.parameter);
    result.unique = (word & plan::point_unique) != 0;
    const Vector away = point - nearest.point;
    const double distance = std::sqrt(nearest.squared_distance);
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

void write_feature(const DistanceFieldQuery& query, const PlacedPolygon& b, double touching,
                   std::size_t cell, std::uint32_t word, DistanceFieldResult& result) {
    const std::size_t row = cell / result.width;
    const Vector centre(static_cast<double>(cell % result.width) + 0.5,
                        static_cast<double>(row) + 0.5);
    const FieldFeature nearest =
        field_feature(b, touching, geometry::to_vector(result.origin) + result.cell * centre, word);
    result.unique[cell] = nearest.unique ? 1 : 0;
    if (query.features) {
        result.features[cell] = nearest.feature;
    }
    if (query.gradients && query.gradient == GradientMethod::analytic) {
        result.gradients[2 * cell] = static_cast<float>(nearest.gradient.x());
        result.gradients[2 * cell + 1] = static_cast<float>(nearest.gradient.y());
    }
}

}  // namespace nearfield
