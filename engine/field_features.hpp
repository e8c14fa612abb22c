#pragma once

#include <engine/geometry/placed_polygon.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>

/// What follows, in double precision, from the edge that was found nearest to a place of a field.
namespace nearfield {

/// What the word of a cell or a point (gpu_layout.hpp) stands for.
struct FieldFeature {
    Feature feature;
    geometry::Vector gradient = geometry::Vector::Zero();  ///< analytic
    bool unique = true;
};

/// `touching`: a place nearer to the boundary than this could lie on either side of it.
[[nodiscard]] FieldFeature field_feature(const geometry::PlacedPolygon& b, double touching,
                                         const geometry::Vector& point, std::uint32_t word);

/// Writes what is asked for of the feature at a cell of a field's result.
void write_feature(const DistanceFieldQuery& query, const geometry::PlacedPolygon& b,
                   double touching, std::size_t cell, std::uint32_t word,
                   DistanceFieldResult& result);

}  // namespace nearfield
