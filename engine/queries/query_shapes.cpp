#include <engine/queries/query_shapes.hpp>

#include <algorithm>
#include <array>

namespace nearfield::queries {
namespace {

/// A shape that has been looked up.
struct KnownShape {
    ShapeHandle handle;  // initially the null handle
    const geometry::Polygon* polygon = nullptr;
};

}  // namespace

void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes) {
    shapes.resize(queries.size());
    // Callers with many pairs query both directions, or pairs of shapes near each other in turn, so
    // most shapes are those of few queries before.
    std::array<KnownShape, 16> known;  // by the low bits of the index
    const auto find = [&](ShapeHandle shape) {
        KnownShape& place = known[shape.index % known.size()];
        if (place.handle != shape) {
            place = {shape, find_shape(shape)};
        }
        return place.polygon;
    };
    std::transform(queries.begin(), queries.end(), shapes.begin(), [&](const AnyQuery& any) {
        return std::visit(
            [&](const auto& query) {
                return QueryShapes{find(query.a.shape), find(query.b.shape)};
            },
            any);
    });
}

}  // namespace nearfield::queries
