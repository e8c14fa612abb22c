#include <engine/plan/query_shapes.hpp>

#include <algorithm>

namespace nearfield::plan {

void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes) {
    shapes.resize(queries.size());
    // Callers with many pairs often query both directions, or all pairs of one shape in turn, so
    // most shapes are those of the query before. Initially the null handle.
    ShapeHandle last_a;
    ShapeHandle last_b;
    QueryShapes last;
    const auto find = [&](ShapeHandle shape) {
        return shape == last_a ? last.a : shape == last_b ? last.b : find_shape(shape);
    };
    std::transform(queries.begin(), queries.end(), shapes.begin(), [&](const AnyQuery& any) {
        std::visit(
            [&](const auto& query) {
                last = {find(query.a.shape), find(query.b.shape)};
                last_a = query.a.shape;
                last_b = query.b.shape;
            },
            any);
        return last;
    });
}

}  // namespace nearfield::plan
