#include <engine/solvers/field_features.hpp>
#include <engine/solvers/nearest_feature.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>

namespace nearfield::solvers {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

/// The outward unit normal of an edge at a place on it; zero if no edge of its ring has a length.
/// The side is tested a step aside, and some steps away from the ends, where a neighbour is as
/// near.
Vector outward_normal(const TransformedPolygon& b, std::uint32_t edge, double parameter,
                      double step) {
    constexpr double steps_from_ends = 4096.0;
    const auto way_along = [&](std::uint32_t i) -> Vector {
        return b.vertex(b.polygon().next(i)) - b.vertex(i);
    };
    std::uint32_t own = edge;
    while (way_along(own).isZero(0.0) && b.polygon().next(own) != edge) {
        own = b.polygon().next(own);
        parameter = 0.0;
    }
    const Vector along = way_along(own);
    const double length = along.norm();
    if (length == 0.0) {
        return Vector::Zero();
    }
    const Vector normal(-along.y() / length, along.x() / length);
    const double margin = std::min(steps_from_ends * step / length, 0.25);
    const Vector place = b.vertex(own) + std::clamp(parameter, margin, 1.0 - margin) * along;
    return geometry::contains(b, place + step * normal) ? Vector(-normal) : normal;
}

}  // namespace

FieldFeature field_feature(const TransformedPolygon& b, double touching, const Vector& point,
                           std::uint32_t word) {
    const std::uint32_t edge = word & shaders::point_edge_mask;
    const auto nearest = nearest_on_edge(b, edge, point);
    FieldFeature result;
    result.feature = feature_at(b, edge, nearest.parameter);
    result.unique = (word & shaders::point_unique) != 0;
    const Vector away = point - nearest.point;
    const double distance = std::sqrt(nearest.squared_distance);
    if (distance > touching) {
        const bool inside = (word & shaders::point_inside) != 0;
        result.gradient = (inside ? -1.0 : 1.0) / distance * away;
    } else {
        // On the boundary the direction from the nearest point is undefined, but the edge's normal
        // is not.
        result.gradient = outward_normal(b, edge, nearest.parameter, 2.0 * touching);
        result.unique = result.unique && !result.gradient.isZero();
    }
    return result;
}

void write_feature(const DistanceFieldQuery& query, const TransformedPolygon& b, double touching,
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

}  // namespace nearfield::solvers
