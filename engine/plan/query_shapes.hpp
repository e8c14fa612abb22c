#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/query.hpp>

#include <functional>
#include <span>
#include <vector>

namespace nearfield::plan {

/// Finds a shape's polygon, or null.
using FindShape = std::function<const geometry::Polygon*(ShapeHandle)>;

/// The polygons of a query; null where it has none, or names one that is not there.
struct QueryShapes {
    const geometry::Polygon* a = nullptr;
    const geometry::Polygon* b = nullptr;
};

/// Replaces `shapes` by those of each query, looked up once for all that need them.
void find_shapes(std::span<const AnyQuery> queries, const FindShape& find_shape,
                 std::vector<QueryShapes>& shapes);

}  // namespace nearfield::plan
