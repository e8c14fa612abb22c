#include <engine/geometry/segment.hpp>
#include <engine/solvers/intersection_samples.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::solvers {
namespace {

/// The edge of A nearest to a point, among a run of edges.
std::uint32_t nearest_edge(const queries::CheckedQuery& query, queries::EdgeRun run,
                           const geometry::Vector& point) {
    if (run.count == 1) {
        return run.first;
    }
    const geometry::TransformedPolygon a(*query.a, query.pose_a);
    std::uint32_t nearest = run.first;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t edge = run.first; edge < run.first + run.count; ++edge) {
        const double squared =
            geometry::nearest_on_segment(point, a.vertex(edge), a.vertex(a.polygon().next(edge)))
                .squared_distance;
        if (squared < best) {
            best = squared;
            nearest = edge;
        }
    }
    return nearest;
}

/// The centre of a cell of a tile, in the world.
geometry::Vector centre_of_cell(const queries::Tile& tile, std::uint32_t column,
                                std::uint32_t row) {
    return tile.grid.origin +
           tile.grid.cell * geometry::Vector(static_cast<double>(tile.column + column) + 0.5,
                                             static_cast<double>(tile.row + row) + 0.5);
}

}  // namespace

IntersectionSample make_sample(const queries::CheckedQuery& query, const queries::Tile& tile,
                               std::uint32_t column, std::uint32_t row, queries::EdgeRun run) {
    const geometry::Vector point = centre_of_cell(tile, column, row);
    const bool by_edge =
        std::get<IntersectionQuery>(*query.query).kind != IntersectionKind::volume_volume;
    return {geometry::to_public(point),
            by_edge ? nearest_edge(query, run, point) : IntersectionSample::no_edge};
}

void add_summary(const queries::Tile& tile, const shaders::TileSummary& summary,
                 IntersectionResult& result) {
    if (summary.count == 0) {
        return;
    }
    const Vector2 low =
        geometry::to_public(centre_of_cell(tile, summary.low_column, summary.low_row));
    const Vector2 high =
        geometry::to_public(centre_of_cell(tile, summary.high_column, summary.high_row));
    Rectangle& box = result.box;
    if (result.count == 0) {
        box = {low, high};
    }
    box.min = {std::min(box.min.x, low.x), std::min(box.min.y, low.y)};
    box.max = {std::max(box.max.x, high.x), std::max(box.max.y, high.y)};
    result.count += summary.count;
}

}  // namespace nearfield::solvers
