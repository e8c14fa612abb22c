#include <engine/queries/simplified_boundary.hpp>

namespace nearfield::queries {

using geometry::Box;

void append_boxes(const geometry::Polygon& polygon, std::span<const geometry::SimplifiedEdge> edges,
                  std::vector<Box>& boxes) {
    const auto vertices = polygon.vertices();
    std::size_t level = boxes.size();
    for (std::size_t first = 0; first < edges.size(); first += SimplifiedBoundary::fan_out) {
        Box box;
        const std::size_t end = std::min(first + SimplifiedBoundary::fan_out, edges.size());
        for (std::size_t i = first; i < end; ++i) {
            box.extend(vertices[edges[i].first]);
            box.extend(vertices[edges[i].last]);
        }
        boxes.push_back(box);
    }
    while (boxes.size() - level > 1) {
        const std::size_t above = boxes.size();
        for (std::size_t first = level; first < above; first += SimplifiedBoundary::fan_out) {
            Box box;
            const std::size_t end = std::min(first + SimplifiedBoundary::fan_out, above);
            for (std::size_t i = first; i < end; ++i) {
                box.extend(boxes[i]);
            }
            boxes.push_back(box);
        }
        level = above;
    }
}

}  // namespace nearfield::queries
