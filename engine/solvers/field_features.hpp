#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>

/// Derives field features, in double precision, from the edge found nearest to a point of a field.
namespace nearfield::solvers {

/// The decoded word of a cell or a point (shaders/layout.h).
struct FieldFeature {
    Feature feature;
    geometry::Vector gradient = geometry::Vector::Zero();  ///< analytic
    bool unique = true;
};

/// `touching`: closer to the boundary than this, the side is undecided.
[[nodiscard]] FieldFeature field_feature(const geometry::TransformedPolygon& b, double touching,
                                         const geometry::Vector& point, std::uint32_t word);

/// Writes the requested parts of the feature at a cell of a field's result.
void write_feature(const DistanceFieldQuery& query, const geometry::TransformedPolygon& b,
                   double touching, std::size_t cell, std::uint32_t word,
                   DistanceFieldResult& result);

}  // namespace nearfield::solvers
