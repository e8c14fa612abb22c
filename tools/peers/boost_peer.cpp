#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <tools/peers/peer.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::peers {
namespace {

namespace bg = boost::geometry;

using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint>;
using BoostLine = bg::model::linestring<BoostPoint>;

BoostPoint boost_point(Vector2 point) {
    return {point.x, point.y};
}

/// Boost.Geometry's algorithms alone, without an index built by the caller.
class Boost final : public Peer {
public:
    [[nodiscard]] std::string name() const override { return "Boost"; }
    [[nodiscard]] std::string how(Task task) const override;
    void build(std::span<const PlacedShape> shapes, Task task) override;

    bool is_inside(std::size_t shape, Vector2 point) override {
        return bg::within(boost_point(point), shapes_[shape].area);
    }
    double distance_to_boundary(std::size_t shape, Vector2 point) override;
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

std::string Boost::how(Task task) const {
    switch (task) {
        case Task::vertex_penetration:
        case Task::boundary_penetration:
            return "within of each point in B's box, distance of those inside to B's boundary: "
                   "every edge is looked at; a depth, no direction";
        case Task::separation:
            return "distance of polygons; no points, no direction";
        case Task::intersection_test:
            return "intersects of polygons";
        case Task::common_area:
            return "area of the intersection, exact";
        case Task::field:
            return {};  // every cell times every edge
    }
    return {};
}

void Boost::build(std::span<const PlacedShape> shapes, Task task) {
    const bool needs_lines = task == Task::vertex_penetration || task == Task::boundary_penetration;
    shapes_.clear();
    for (const PlacedShape& placed : shapes) {
        Shape& shape = shapes_.emplace_back();
        for (std::size_t number = 0; number < placed.rings.size(); ++number) {
            BoostLine line;
            for (const Vector2& vertex : placed.rings[number]) {
                line.push_back(boost_point(vertex));
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

double Boost::distance_to_boundary(std::size_t shape, Vector2 point) {
    double least = std::numeric_limits<double>::infinity();
    for (const BoostLine& line : shapes_[shape].lines) {
        least = std::min(least, bg::distance(boost_point(point), line));
    }
    return least;
}

}  // namespace

std::unique_ptr<Peer> make_boost_peer() {
    return std::make_unique<Boost>();
}

}  // namespace nearfield::peers
