#include <geos_c.h>
#include <tools/peers/peer.hpp>

#include <stdexcept>

namespace nearfield::peers {
namespace {

/// GEOS through its C interface, the one with a stability promise.
class Geos final : public Peer {
public:
    Geos() : context_(GEOS_init_r()) {}
    ~Geos() override {
        clear();
        GEOS_finish_r(context_);
    }
    Geos(const Geos&) = delete;
    Geos& operator=(const Geos&) = delete;

    [[nodiscard]] std::string name() const override { return "GEOS"; }
    [[nodiscard]] std::string how(Task task) const override;
    void build(std::span<const PlacedShape> shapes, Task task) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override;
    double separation(std::size_t a, std::size_t b) override;
    bool intersect(std::size_t a, std::size_t b) override;
    double common_area(std::size_t a, std::size_t b) override;

private:
    struct Shape {
        GEOSGeometry* area = nullptr;
        GEOSGeometry* line = nullptr;
        const GEOSPreparedGeometry* prepared_area = nullptr;
        const GEOSPreparedGeometry* prepared_line = nullptr;
    };

    void clear();
    [[nodiscard]] GEOSGeometry* ring_of(const Ring& ring);
    [[nodiscard]] GEOSGeometry* area_of(const PlacedShape& shape);
    template <class Value>
    [[nodiscard]] static Value checked(Value value, bool good, const char* what) {
        if (!good) {
            throw std::runtime_error(std::string("GEOS: ") + what + " failed");
        }
        return value;
    }

    GEOSContextHandle_t context_;
    std::vector<Shape> shapes_;
};

std::string Geos::how(Task task) const {
    switch (task) {
        case Task::vertex_penetration:
        case Task::boundary_penetration:
            return "prepared contains of each point in B's box, prepared (indexed facet) distance "
                   "of those inside to B's boundary; a depth, no direction";
        case Task::separation:
            return "prepared distance; no points, no direction";
        case Task::intersection_test:
            return "prepared intersects";
        case Task::common_area:
            return "area of the intersection, exact";
        case Task::field:
            return "prepared distance to B's boundary and prepared contains, cell by cell";
    }
    return {};
}

void Geos::clear() {
    for (const Shape& shape : shapes_) {
        GEOSPreparedGeom_destroy_r(context_, shape.prepared_area);
        GEOSPreparedGeom_destroy_r(context_, shape.prepared_line);
        GEOSGeom_destroy_r(context_, shape.area);
        GEOSGeom_destroy_r(context_, shape.line);
    }
    shapes_.clear();
}

GEOSGeometry* Geos::ring_of(const Ring& ring) {
    std::vector<double> numbers;
    numbers.reserve(2 * ring.size() + 2);
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Vector2& vertex = ring[i % ring.size()];
        numbers.push_back(vertex.x);
        numbers.push_back(vertex.y);
    }
    GEOSCoordSequence* const sequence = GEOSCoordSeq_copyFromBuffer_r(
        context_, numbers.data(), static_cast<unsigned>(ring.size() + 1), 0, 0);
    GEOSGeometry* const result = GEOSGeom_createLinearRing_r(context_, sequence);
    return checked(result, result != nullptr, "making a ring");
}

GEOSGeometry* Geos::area_of(const PlacedShape& shape) {
    std::vector<GEOSGeometry*> holes;
    for (std::size_t ring = 1; ring < shape.rings.size(); ++ring) {
        holes.push_back(ring_of(shape.rings[ring]));
    }
    GEOSGeometry* const result = GEOSGeom_createPolygon_r(
        context_, ring_of(shape.rings.front()), holes.data(), static_cast<unsigned>(holes.size()));
    return checked(result, result != nullptr, "making a polygon");
}

void Geos::build(std::span<const PlacedShape> shapes, Task task) {
    clear();
    const bool needs_line = task == Task::vertex_penetration ||
                            task == Task::boundary_penetration || task == Task::field;
    for (const PlacedShape& placed : shapes) {
        Shape& shape = shapes_.emplace_back();
        shape.area = area_of(placed);
        if (task != Task::common_area) {
            shape.prepared_area = GEOSPrepare_r(context_, shape.area);
        }
        if (needs_line) {
            shape.line = GEOSBoundary_r(context_, shape.area);
            shape.prepared_line = GEOSPrepare_r(context_, shape.line);
        }
    }
}

bool Geos::is_inside(std::size_t shape, Vector2 point) {
    GEOSGeometry* const geometry = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
    const char inside = GEOSPreparedContains_r(context_, shapes_[shape].prepared_area, geometry);
    GEOSGeom_destroy_r(context_, geometry);
    return checked(inside == 1, inside != 2, "contains");
}

double Geos::distance_to_boundary(std::size_t shape, Vector2 point) {
    GEOSGeometry* const geometry = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
    double distance = 0.0;
    const int done =
        GEOSPreparedDistance_r(context_, shapes_[shape].prepared_line, geometry, &distance);
    GEOSGeom_destroy_r(context_, geometry);
    return checked(distance, done == 1, "distance");
}

double Geos::separation(std::size_t a, std::size_t b) {
    double distance = 0.0;
    const int done =
        GEOSPreparedDistance_r(context_, shapes_[b].prepared_area, shapes_[a].area, &distance);
    return checked(distance, done == 1, "distance");
}

bool Geos::intersect(std::size_t a, std::size_t b) {
    const char meet = GEOSPreparedIntersects_r(context_, shapes_[b].prepared_area, shapes_[a].area);
    return checked(meet == 1, meet != 2, "intersects");
}

double Geos::common_area(std::size_t a, std::size_t b) {
    GEOSGeometry* const common = GEOSIntersection_r(context_, shapes_[a].area, shapes_[b].area);
    double area = 0.0;
    const bool done = common != nullptr && GEOSArea_r(context_, common, &area) == 1;
    GEOSGeom_destroy_r(context_, common);
    return checked(area, done, "intersection");
}

}  // namespace

std::unique_ptr<Peer> make_geos_peer() {
    return std::make_unique<Geos>();
}

}  // namespace nearfield::peers
