#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/search_shapes.hpp>

#include <shaders/pairs.h>

namespace nearfield::plan {

/// Sets what an instance has of its shape, except for its places in the input.
void set_shape(const geometry::Polygon& polygon, SearchInstanceData& data);
/// Sets what it has of its pose. `origin`: that positions are relative to.
void set_place(const geometry::TransformedPolygon& placed, const geometry::Vector& origin,
               SearchInstanceData& data);

/// Bound on the rounding of a vertex's place in double precision, where no number that occurs
/// exceeds `magnitude`.
[[nodiscard]] float rounding_at(double magnitude);

/// Bound on the errors of the device's single precision for a pair, world units; as
/// shaders/pair_directions.comp has it.
[[nodiscard]] double margin_of_pair(const SearchInstanceData& a, const SearchInstanceData& b);

}  // namespace nearfield::plan
