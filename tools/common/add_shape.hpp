#pragma once

#include <nearfield/context.hpp>

#include <span>

namespace nearfield::tools {

/// Adds a shape. Where rings are refused, the status names all of them, not only the first (twenty,
/// then how many more): number, first vertex and reason.
[[nodiscard]] Expected<ShapeHandle> add_shape(Context& context, std::span<const Ring> rings,
                                              double deviation);

}  // namespace nearfield::tools
