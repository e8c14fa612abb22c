#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <tools/peers/peer.hpp>

namespace nearfield::peers {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using TreePoint = bg::model::d2::point_xy<double>;
using TreeSegment = bg::model::segment<TreePoint>;
using TreeBox = bg::model::box<TreePoint>;
using SegmentTree = bgi::rtree<TreeSegment, bgi::rstar<16>>;

/// True if the edge crosses a ray from the point to the right.
bool crosses_ray(const TreeSegment& edge, Vector2 point) {
    const TreePoint& from = edge.first;
    const TreePoint& to = edge.second;
    if ((from.y() > point.y) == (to.y() > point.y)) {
        return false;
    }
    return point.x < from.x() + (point.y - from.y()) / (to.y() - from.y()) * (to.x() - from.x());
}

/// Boost.Geometry with a packed R-tree of B's edges, as a caller would add for many points.
class BoostTree final : public Peer {
public:
    [[nodiscard]] std::string name() const override { return "Boost R-tree"; }
    [[nodiscard]] std::string how(Task task) const override {
        if (task == Task::separation || task == Task::intersection_test ||
            task == Task::common_area) {
            return {};
        }
        return "R-tree of B's edges: nearest one, and those a ray may cross; the parity of the "
               "crossings is the caller's; a depth, no direction";
    }
    void build(std::span<const PlacedShape> shapes, Task task) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override;

private:
    struct Shape {
        SegmentTree tree;
        double right = 0.0;
    };

    std::vector<Shape> shapes_;
};

void BoostTree::build(std::span<const PlacedShape> shapes, Task /*task*/) {
    shapes_.clear();
    std::vector<TreeSegment> edges;
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
    const TreeBox ray({point.x, point.y}, {in.right, point.y});
    bool inside = false;
    for (auto edge = in.tree.qbegin(bgi::intersects(ray)); edge != in.tree.qend(); ++edge) {
        inside = inside != crosses_ray(*edge, point);
    }
    return inside;
}

double BoostTree::distance_to_boundary(std::size_t shape, Vector2 point) {
    const TreePoint from(point.x, point.y);
    return bg::distance(from, *shapes_[shape].tree.qbegin(bgi::nearest(from, 1)));
}

}  // namespace

std::unique_ptr<Peer> make_boost_tree_peer() {
    return std::make_unique<BoostTree>();
}

}  // namespace nearfield::peers
