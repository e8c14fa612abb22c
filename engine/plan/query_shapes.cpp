#include <engine/plan/query_shapes.hpp>

#include <algorithm>

namespace nearfield::plan {

void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes) {
    shapes.resize(queries.size());
    // Who asks about many pairs asks both ways, or about all pairs of one shape in turn: most
    // shapes are those of the query before. At first that is none.
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
