#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::test {

/// The degenerate polygons of support::degenerate_polygons in a square of `cells` that a context
/// accepts. Another test covers the rejected ones.
std::vector<NamedRings> degenerate_shapes(Context& context, std::uint32_t cells,
                                          std::uint64_t seed);

}  // namespace nearfield::test
