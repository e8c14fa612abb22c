#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <tools/peers/peer.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::peers {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint>;
using BoostLine = bg::model::linestring<BoostPoint>;
using BoostSegment = bg::model::segment<BoostPoint>;
using SegmentTree = bgi::rtree<BoostSegment, bgi::rstar<16>>;

constexpr const char* points_method =
    "within of each point in B's box, distance of those inside to B's boundary: every edge is "
    "looked at; a depth, no direction";

/// Boost.Geometry's algorithms alone, without an index built by the caller.
class Boost final : public Peer {
public:
    Boost()
        : Peer("Boost", {{Task::vertex_penetration, points_method},
                         {Task::boundary_penetration, points_method},
                         {Task::separation, "distance of polygons; no points, no direction"},
                         {Task::intersection_test, "intersects of polygons"},
                         {Task::common_area, "area of the intersection, exact"}}) {}

    void build(const Problem& problem, std::span<const PlacedShape> shapes) override;
    bool is_inside(std::size_t shape, Vector2 point) override {
        return bg::within(BoostPoint(point.x, point.y), shapes_[shape].area);
    }
    double distance_to_boundary(std::size_t shape, Vector2 point) override {
        double least = std::numeric_limits<double>::infinity();
        for (const BoostLine& line : shapes_[shape].lines) {
            least = std::min(least, bg::distance(BoostPoint(point.x, point.y), line));
        }
        return least;
    }
    double separation(std::size_t a, std::size_t b) override {
        return bg::distance(shapes_[a].area, shapes_[b].area);
    }
    bool intersect(std::size_t a, std::size_t b) override {
        return bg::intersects(shapes_[a].area, shapes_[b].area);
    }
    double common_area(std::size_t a, std::size_t b) override {
        std::vector<BoostPolygon> common;
        bg::intersection(shapes_[a].area, shapes_[b].area, common);
        double area = 0.0;
        for (const BoostPolygon& part : common) {
            area += bg::area(part);
        }
        return area;
    }

private:
    struct Shape {
        BoostPolygon area;
        std::vector<BoostLine> lines;
    };

    std::vector<Shape> shapes_;
};

void Boost::build(const Problem& problem, std::span<const PlacedShape> shapes) {
    const bool needs_lines =
        problem.task == Task::vertex_penetration || problem.task == Task::boundary_penetration;
    shapes_.clear();
    for (const PlacedShape& placed : shapes) {
        Shape& shape = shapes_.emplace_back();
        for (std::size_t number = 0; number < placed.rings.size(); ++number) {
            BoostLine line;
            for (const Vector2& vertex : placed.rings[number]) {
                line.emplace_back(vertex.x, vertex.y);
            }
            line.push_back(line.front());
            if (number == 0) {
                bg::append(shape.area, line);
            } else {
                shape.area.inners().emplace_back(line.begin(), line.end());
            }
            if (needs_lines) {
                shape.lines.push_back(line);
            }
        }
        bg::correct(shape.area);
    }
}

/// True if the edge crosses a ray from the point to the right.
bool crosses_ray(const BoostSegment& edge, Vector2 point) {
    const BoostPoint& from = edge.first;
    const BoostPoint& to = edge.second;
    if ((from.y() > point.y) == (to.y() > point.y)) {
        return false;
    }
    return point.x < from.x() + (point.y - from.y()) / (to.y() - from.y()) * (to.x() - from.x());
}

constexpr const char* tree_method =
    "R-tree of B's edges: nearest one, and those a ray may cross; the parity of the crossings is "
    "the "
    "caller's; a depth, no direction";

/// Boost.Geometry with a packed R-tree of B's edges, as a caller would add for many points.
class BoostTree final : public Peer {
public:
    BoostTree()
        : Peer("Boost R-tree", {{Task::vertex_penetration, tree_method},
                                {Task::boundary_penetration, tree_method},
                                {Task::field, tree_method}}) {}

    void build(const Problem& problem, std::span<const PlacedShape> shapes) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override {
        const BoostPoint from(point.x, point.y);
        return bg::distance(from, *shapes_[shape].tree.qbegin(bgi::nearest(from, 1)));
    }

private:
    struct Shape {
        SegmentTree tree;
        double right = 0.0;
    };

    std::vector<Shape> shapes_;
};

void BoostTree::build(const Problem& /*problem*/, std::span<const PlacedShape> shapes) {
    shapes_.clear();
    std::vector<BoostSegment> edges;
    for (const PlacedShape& placed : shapes) {
        edges.clear();
        for (const Ring& ring : placed.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vector2& from = ring[i];
                const Vector2& to = ring[(i + 1) % ring.size()];
                edges.push_back({{from.x, from.y}, {to.x, to.y}});
            }
        }
        shapes_.push_back({SegmentTree(edges.begin(), edges.end()), placed.box.max.x});
    }
}

bool BoostTree::is_inside(std::size_t shape, Vector2 point) {
    const Shape& in = shapes_[shape];
    if (point.x > in.right) {
        return false;
    }
    const bg::model::box<BoostPoint> ray({point.x, point.y}, {in.right, point.y});
    bool inside = false;
    for (auto edge = in.tree.qbegin(bgi::intersects(ray)); edge != in.tree.qend(); ++edge) {
        inside = inside != crosses_ray(*edge, point);
    }
    return inside;
}

}  // namespace

std::unique_ptr<Peer> make_boost_peer() {
    return std::make_unique<Boost>();
}

std::unique_ptr<Peer> make_boost_tree_peer() {
    return std::make_unique<BoostTree>();
}

}  // namespace nearfield::peers
