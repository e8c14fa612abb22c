#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/query.hpp>

#include <functional>
#include <span>
#include <vector>

namespace nearfield::queries {

/// Finds a shape's polygon; null if there is none.
using FindShape = std::function<const geometry::Polygon*(ShapeHandle)>;

/// The polygons of a query; null where the query names no shape, or one that does not exist.
struct QueryShapes {
    const geometry::Polygon* a = nullptr;
    const geometry::Polygon* b = nullptr;
};

/// Replaces `shapes` by those of each query, looked up once for all users.
void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes);

}  // namespace nearfield::queries
