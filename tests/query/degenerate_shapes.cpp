#include <gtest/gtest.h>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/support/degenerate_polygons.hpp>

#include <utility>

namespace nearfield::test {
namespace {

Rings plain(const support::Rings& rings) {
    Rings result;
    for (const auto& ring : rings) {
        Ring& plain_ring = result.emplace_back();
        for (const auto& vertex : ring) {
            plain_ring.push_back({vertex.x(), vertex.y()});
        }
    }
    return result;
}

}  // namespace

std::vector<NamedRings> degenerate_shapes(Context& context, std::uint32_t cells,
                                          std::uint64_t seed) {
    std::vector<NamedRings> shapes;
    for (const support::DegeneratePolygon& degenerate :
         support::degenerate_polygons(cells, cells, static_cast<std::uint32_t>(seed))) {
        Rings rings = plain(degenerate.rings);
        if (const auto shape = context.add_shape(rings); shape.has_value()) {
            EXPECT_TRUE(context.remove_shape(*shape).ok());
            shapes.push_back({degenerate.name, std::move(rings)});
        }
    }
    EXPECT_GE(shapes.size(), 6U);
    return shapes;
}

}  // namespace nearfield::test
