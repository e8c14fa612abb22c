#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/search_shapes.hpp>

#include <shaders/pairs.h>

namespace nearfield::plan {

/// An instance for the search for all pairs (shaders/pairs.h), without its shape's places in the
/// input and without its filter. `origin`: that positions are relative to.
[[nodiscard]] SearchInstanceData search_instance(const geometry::TransformedPolygon& placed,
                                                 const geometry::Vector& origin);

/// Bound on the errors of the device's single precision for a pair, world units; as
/// shaders/pair_directions.comp has it.
[[nodiscard]] double margin_of_pair(const SearchInstanceData& a, const SearchInstanceData& b);

}  // namespace nearfield::plan
