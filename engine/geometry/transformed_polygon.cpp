#include <engine/geometry/transformed_polygon.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace nearfield::geometry {

TransformedPolygon::TransformedPolygon(const Polygon& polygon, const Pose& pose)
    : TransformedPolygon(polygon, pose, sine_cosine(pose.angle)) {}

TransformedPolygon::TransformedPolygon(const Polygon& polygon, const Pose& pose,
                                       const SineCosine& turn)
    : polygon_(&polygon) {
    rotation_ << turn.cosine, -turn.sine, turn.sine, turn.cosine;
    translation_ = rotation_ * polygon.centre() + to_vector(pose.translation);
}

Box TransformedPolygon::box_of(std::span<const Vector> vertices) const {
    // For this few, computing the box takes less time than setting up the widest vectors.
    constexpr std::size_t one_by_one = 4;
    if (vertices.size() <= one_by_one) {
        Box box;
        for (const Vector& vertex : vertices) {
            box.extend(to_world(vertex));
        }
        return box;
    }
    return geometry::box_of(kernels::find_extent(vertices, placement()));
}

Box TransformedPolygon::chain_box(std::uint32_t ring, std::uint32_t first,
                                  std::uint32_t count) const {
    const std::span<const Vector> vertices = polygon_->vertices();
    const std::uint32_t begin = polygon_->ring_begin(ring);
    const std::uint32_t before_wrap = std::min(count + 1, polygon_->ring_end(ring) - first);
    Box box = box_of(vertices.subspan(first, before_wrap));
    if (before_wrap <= count) {
        box.extend(box_of(vertices.subspan(begin, count + 1 - before_wrap)));
    }
    return box;
}

Box TransformedPolygon::box() const {
    // Of fewer vertices, to place them all takes less time than to search the boxes.
    constexpr std::uint32_t many = 2048;
    const EdgeBoxes* const boxes =
        polygon_->size() >= many ? polygon_->find_boxes(BoxSearch::extent) : nullptr;
    return boxes != nullptr ? kernels::find_box(*this, *boxes) : box_of(polygon_->vertices());
}

bool contains(const TransformedPolygon& placed, const Vector& point) {
    // Transform one point to local coordinates rather than every vertex to the world.
    const Vector p = placed.to_local(point);
    const Polygon& polygon = placed.polygon();
    const std::span<const Vector> vertices = polygon.vertices();
    bool inside = false;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        const std::uint32_t end = polygon.ring_end(ring);
        Vector a = vertices[end - 1];
        for (const Vector& b : vertices.subspan(begin, end - begin)) {
            // Half open: a vertex level with the ray belongs only to the edge that goes up from it,
            // so a ray through a vertex counts correctly.
            if ((a.y() > p.y()) != (b.y() > p.y())) {
                const bool left = cross(b - a, p - a) > 0.0;
                const bool upward = b.y() > a.y();
                inside = inside != (left == upward);
            }
            a = b;
        }
    }
    return inside;
}

}  // namespace nearfield::geometry
