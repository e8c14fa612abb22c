#include <engine/geometry/hierarchy.hpp>

#include <limits>
#include <span>

namespace nearfield::geometry {

Node Hierarchy::root() {
    return rings_node(0, polygon_->polygon().ring_count());
}

bool Hierarchy::splits(const Node& node) const {
    return node.rings > 1 || (node.count > 1 && node.height < height_);
}

std::array<Node, 2> Hierarchy::halves(const Node& node) {
    if (node.rings > 1) {
        const std::uint32_t half = node.rings / 2;
        return {rings_node(node.ring, half), rings_node(node.ring + half, node.rings - half)};
    }
    const std::uint32_t half = node.count / 2;
    return {edges_node(node, node.first, half),
            edges_node(node, node.first + half, node.count - half)};
}

Node Hierarchy::rings_node(std::uint32_t ring, std::uint32_t rings) {
    const Polygon& polygon = polygon_->polygon();
    const std::uint32_t begin = polygon.ring_begin(ring);
    Node node{ring, rings, begin, polygon.ring_end(ring + rings - 1) - begin, 0, {}};
    for (std::uint32_t r = ring; r < ring + rings; ++r) {
        const std::uint32_t first = polygon.ring_begin(r);
        // The vertices of all edges but the last are all of a ring's vertices.
        node.box.extend(polygon_->chain_box(r, first, polygon.ring_end(r) - first - 1));
    }
    if (volume_ == BoundingVolume::oriented) {
        add_oriented_box(node);
    }
    ++nodes_evaluated_;
    return node;
}

Node Hierarchy::edges_node(const Node& parent, std::uint32_t first, std::uint32_t count) {
    ++nodes_evaluated_;
    Node node{parent.ring,
              1,
              first,
              count,
              parent.height + 1,
              polygon_->chain_box(parent.ring, first, count)};
    if (volume_ == BoundingVolume::oriented) {
        add_oriented_box(node);
    }
    return node;
}

void Hierarchy::add_oriented_box(Node& node) {
    if (rounding_ == 0.0) {
        // The root comes first and has the box of everything. Axes, projections and centres round a
        // few times more than transforming a vertex does.
        rounding_ = 4.0 * placement_rounding(*polygon_, node.box);
    }
    const std::span<const Vector> vertices = polygon_->polygon().vertices();
    const std::uint32_t end = node.first + node.count;
    if (node.rings > 1 || end < polygon_->polygon().ring_end(node.ring)) {
        // All vertices of the rings, or those of the edges plus the one where the last edge ends.
        const std::uint32_t count = node.rings > 1 ? node.count : node.count + 1;
        node.oriented = oriented_box(*polygon_, vertices.subspan(node.first, count), {}, rounding_);
    } else {
        const std::uint32_t begin = polygon_->polygon().ring_begin(node.ring);
        node.oriented = oriented_box(*polygon_, vertices.subspan(node.first, node.count),
                                     vertices.subspan(begin, 1), rounding_);
    }
}

double placement_rounding(const TransformedPolygon& polygon, const Box& box) {
    // Every step of the transform (centring, rotating the centre and the vertex, adding) rounds by
    // at most half an epsilon of its operands, and none of these exceed the centre's and the
    // result's magnitudes by much.
    const double magnitude = box.min().lpNorm<Eigen::Infinity>() +
                             box.max().lpNorm<Eigen::Infinity>() +
                             polygon.polygon().centre().lpNorm<Eigen::Infinity>();
    return 4.0 * std::numeric_limits<double>::epsilon() * magnitude;
}

}  // namespace nearfield::geometry
