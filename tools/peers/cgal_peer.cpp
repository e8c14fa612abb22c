#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>
#include <tools/peers/peer.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::peers {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Segments = std::vector<Kernel::Segment_3>;
using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 in_plane(Vector2 point) {
    return {point.x, point.y, 0.0};
}

/// CGAL's AABB tree is three-dimensional only in this version, so edges lie in the plane z = 0.
class Cgal final : public Peer {
public:
    [[nodiscard]] std::string name() const override { return "CGAL"; }
    [[nodiscard]] std::string how(Task task) const override;
    [[nodiscard]] bool signed_field() const override { return false; }
    void build(std::span<const PlacedShape> shapes, Task task) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override {
        return std::sqrt(shapes_[shape]->tree.squared_distance(in_plane(point)));
    }
    double separation(std::size_t a, std::size_t b) override;
    bool intersect(std::size_t a, std::size_t b) override;

private:
    struct Shape {
        Segments edges;
        std::vector<std::vector<Kernel::Point_2>> rings;
        Tree tree;
    };

    [[nodiscard]] bool boundaries_meet(const Shape& a, const Shape& b) const;
    [[nodiscard]] double min_from_vertices(const Shape& a, const Shape& b) const;

    std::vector<std::unique_ptr<Shape>> shapes_;  // trees point into their edges
};

std::string Cgal::how(Task task) const {
    switch (task) {
        case Task::vertex_penetration:
        case Task::boundary_penetration:
            return "bounded_side_2 of each point in B's box, AABB tree's nearest distance of those "
                   "inside; a depth, no direction";
        case Task::separation:
            return "AABB trees: whether boundaries meet, else the nearest distance of each one's "
                   "vertices to the other; no points, no direction";
        case Task::intersection_test:
            return "edges of A against the AABB tree of B, then bounded_side_2 of a vertex of each";
        case Task::common_area:
            return {};
        case Task::field:
            return "AABB tree's nearest distance, cell by cell; no sign";
    }
    return {};
}

void Cgal::build(std::span<const PlacedShape> shapes, Task task) {
    shapes_.clear();
    for (const PlacedShape& placed : shapes) {
        Shape& shape = *shapes_.emplace_back(std::make_unique<Shape>());
        for (const Ring& ring : placed.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                shape.edges.emplace_back(in_plane(ring[i]), in_plane(ring[(i + 1) % ring.size()]));
            }
            if (task != Task::field) {
                auto& points = shape.rings.emplace_back();
                for (const Vector2& vertex : ring) {
                    points.emplace_back(vertex.x, vertex.y);
                }
            }
        }
        shape.tree.insert(shape.edges.cbegin(), shape.edges.cend());
    }
}

bool Cgal::is_inside(std::size_t shape, Vector2 point) {
    bool inside = false;
    for (const auto& ring : shapes_[shape]->rings) {
        inside = inside !=
                 (CGAL::bounded_side_2(ring.begin(), ring.end(), Kernel::Point_2(point.x, point.y),
                                       Kernel()) == CGAL::ON_BOUNDED_SIDE);
    }
    return inside;
}

bool Cgal::boundaries_meet(const Shape& a, const Shape& b) const {
    return std::any_of(a.edges.begin(), a.edges.end(),
                       [&](const Kernel::Segment_3& edge) { return b.tree.do_intersect(edge); });
}

double Cgal::min_from_vertices(const Shape& a, const Shape& b) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Kernel::Segment_3& edge : a.edges) {
        least = std::min(least, b.tree.squared_distance(edge.source()));
    }
    return least;
}

bool Cgal::intersect(std::size_t a, std::size_t b) {
    const Shape& first = *shapes_[a];
    const Shape& second = *shapes_[b];
    const auto vertex_of = [](const Shape& shape) {
        const Kernel::Point_3& point = shape.edges.front().source();
        return Vector2{point.x(), point.y()};
    };
    return boundaries_meet(first, second) || is_inside(b, vertex_of(first)) ||
           is_inside(a, vertex_of(second));
}

double Cgal::separation(std::size_t a, std::size_t b) {
    if (intersect(a, b)) {
        return 0.0;
    }
    const Shape& first = *shapes_[a];
    const Shape& second = *shapes_[b];
    return std::sqrt(std::min(min_from_vertices(first, second), min_from_vertices(second, first)));
}

}  // namespace

std::unique_ptr<Peer> make_cgal_peer() {
    return std::make_unique<Cgal>();
}

}  // namespace nearfield::peers
