#include <engine/plan/query_shapes.hpp>

#include <algorithm>

namespace nearfield::plan {

void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes) {
    shapes.resize(queries.size());
    std::transform(queries.begin(), queries.end(), shapes.begin(), [&](const AnyQuery& any) {
        return std::visit(
            [&](const auto& query) {
                return QueryShapes{find_shape(query.a.shape), find_shape(query.b.shape)};
            },
            any);
    });
}

}  // namespace nearfield::plan
