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

constexpr const char* points_method =
    "bounded_side_2 of each point in B's box, AABB tree's nearest distance of those inside; a "
    "depth, "
    "no direction";

/// CGAL's AABB tree is three-dimensional only in this version, so edges lie in the plane z = 0.
class Cgal final : public Peer {
public:
    Cgal()
        : Peer("CGAL",
               {{Task::vertex_penetration, points_method},
                {Task::boundary_penetration, points_method},
                {Task::separation,
                 "AABB trees: whether boundaries meet, else the nearest distance of each one's "
                 "vertices to the other; no points, no direction"},
                {Task::intersection_test,
                 "edges of A against the AABB tree of B, then bounded_side_2 of a vertex of each"},
                {Task::first_hits,
                 "AABB tree: all edges that a segment intersects, the nearest of them"}}) {}

    void build(const Problem& problem, std::span<const PlacedShape> shapes) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override {
        return std::sqrt(shapes_[shape]->tree.squared_distance(in_plane(point)));
    }
    double separation(std::size_t a, std::size_t b) override;
    bool intersect(std::size_t a, std::size_t b) override;
    void ask_world(const Problem& problem, std::vector<double>& numbers) override;

private:
    struct Shape {
        Segments edges;
        std::vector<std::vector<Kernel::Point_2>> rings;
        Tree tree;
    };

    [[nodiscard]] bool boundaries_meet(const Shape& a, const Shape& b) const;
    [[nodiscard]] double min_from_vertices(const Shape& a, const Shape& b) const;

    std::vector<std::unique_ptr<Shape>> shapes_;  // trees point into their edges; of a world, one
};

void Cgal::build(const Problem& problem, std::span<const PlacedShape> shapes) {
    shapes_.clear();
    for (const PlacedShape& placed : shapes) {
        if (shapes_.empty() || !problem.is_of_world()) {
            shapes_.push_back(std::make_unique<Shape>());
        }
        Shape& shape = *shapes_.back();
        for (const Ring& ring : placed.rings) {
            auto& points = shape.rings.emplace_back();
            for (std::size_t i = 0; i < ring.size(); ++i) {
                shape.edges.emplace_back(in_plane(ring[i]), in_plane(ring[(i + 1) % ring.size()]));
                points.emplace_back(ring[i].x, ring[i].y);
            }
        }
    }
    for (const std::unique_ptr<Shape>& shape : shapes_) {
        shape->tree.insert(shape->edges.cbegin(), shape->edges.cend());
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

/// The parameter at which a segment crosses an edge.
double crossing(const Segment& segment, const Kernel::Segment_3& edge) {
    const double x = segment.to.x - segment.from.x;
    const double y = segment.to.y - segment.from.y;
    const double along_x = edge.target().x() - edge.source().x();
    const double along_y = edge.target().y() - edge.source().y();
    const double to_x = edge.source().x() - segment.from.x;
    const double to_y = edge.source().y() - segment.from.y;
    return (to_x * along_y - to_y * along_x) / (x * along_y - y * along_x);
}

void Cgal::ask_world(const Problem& problem, std::vector<double>& numbers) {
    std::vector<Primitive::Id> found;
    for (const Segment& segment : problem.request().segments) {
        found.clear();
        shapes_.front()->tree.all_intersected_primitives(
            Kernel::Segment_3(in_plane(segment.from), in_plane(segment.to)),
            std::back_inserter(found));
        double first = 2.0;
        for (const Primitive::Id& id : found) {
            first = std::min(first, crossing(segment, *id));
        }
        numbers.push_back(first);
    }
}

}  // namespace

std::unique_ptr<Peer> make_cgal_peer() {
    return std::make_unique<Cgal>();
}

}  // namespace nearfield::peers
