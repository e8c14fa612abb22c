#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::test {

/// Those of support::nasty_polygons in a square of `cells` that a context takes for shapes; some
/// are none, and refusing those is another test's matter.
std::vector<NamedRings> nasty_shapes(Context& context, std::uint32_t cells, std::uint64_t seed);

}  // namespace nearfield::test
