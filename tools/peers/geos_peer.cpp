#include <geos_c.h>
#include <tools/peers/peer.hpp>

#include <limits>
#include <stdexcept>

namespace nearfield::peers {
namespace {

constexpr const char* points_method =
    "prepared contains of each point in B's box, prepared (indexed facet) distance of those inside "
    "to B's boundary; a depth, no direction";

/// GEOS through its C interface, the one with a stability promise.
class Geos final : public Peer {
public:
    Geos()
        : Peer("GEOS",
               {{Task::vertex_penetration, points_method},
                {Task::boundary_penetration, points_method},
                {Task::separation, "prepared distance; no points, no direction"},
                {Task::intersection_test, "prepared intersects"},
                {Task::common_area, "area of the intersection, exact"},
                {Task::field,
                 "prepared distance to B's boundary and prepared contains, cell by cell"},
                {Task::pose_hits, "STRtree query, prepared intersects"},
                {Task::pose_distances, "prepared distance to each of the shapes; a distance alone"},
                {Task::nearest, "STRtree nearest with prepared distance; a distance alone"}}),
          context_(GEOS_init_r()) {}
    ~Geos() override {
        clear();
        GEOS_finish_r(context_);
    }
    Geos(const Geos&) = delete;
    Geos& operator=(const Geos&) = delete;

    void build(const Problem& problem, std::span<const PlacedShape> shapes) override;
    bool is_inside(std::size_t shape, Vector2 point) override;
    double distance_to_boundary(std::size_t shape, Vector2 point) override;
    double separation(std::size_t a, std::size_t b) override {
        return distance(shapes_[b].prepared_area, shapes_[a].area);
    }
    bool intersect(std::size_t a, std::size_t b) override;
    double common_area(std::size_t a, std::size_t b) override;
    void ask_world(const Problem& problem, std::vector<double>& numbers) override;

private:
    struct Shape {
        GEOSContextHandle_t context = nullptr;
        GEOSGeometry* area = nullptr;
        GEOSGeometry* line = nullptr;
        const GEOSPreparedGeometry* prepared_area = nullptr;
        const GEOSPreparedGeometry* prepared_line = nullptr;
    };

    void clear();
    [[nodiscard]] GEOSGeometry* ring_of(const Ring& ring, const Placement& place);
    [[nodiscard]] GEOSGeometry* area_of(const std::vector<Ring>& rings, const Placement& place);
    [[nodiscard]] double distance(const GEOSPreparedGeometry* from, const GEOSGeometry* to) const;
    /// Whether an item meets a shape, its least distance, and the shape nearest to it.
    [[nodiscard]] bool meets(const GEOSGeometry* item) const;
    [[nodiscard]] double least_distance(const GEOSGeometry* item) const;
    [[nodiscard]] const Shape& nearest(const GEOSGeometry* item) const;
    template <class Value>
    [[nodiscard]] static Value checked(Value value, bool good, const char* what) {
        if (!good) {
            throw std::runtime_error(std::string("GEOS: ") + what + " failed");
        }
        return value;
    }

    GEOSContextHandle_t context_;
    GEOSSTRtree* tree_ = nullptr;  ///< of a world
    std::vector<Shape> shapes_;
};

void Geos::clear() {
    if (tree_ != nullptr) {
        GEOSSTRtree_destroy_r(context_, tree_);
        tree_ = nullptr;
    }
    for (const Shape& shape : shapes_) {
        GEOSPreparedGeom_destroy_r(context_, shape.prepared_area);
        GEOSPreparedGeom_destroy_r(context_, shape.prepared_line);
        GEOSGeom_destroy_r(context_, shape.area);
        GEOSGeom_destroy_r(context_, shape.line);
    }
    shapes_.clear();
}

GEOSGeometry* Geos::ring_of(const Ring& ring, const Placement& place) {
    std::vector<double> numbers;
    numbers.reserve(2 * ring.size() + 2);
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Vector2 vertex = place(ring[i % ring.size()]);
        numbers.push_back(vertex.x);
        numbers.push_back(vertex.y);
    }
    GEOSCoordSequence* const sequence = GEOSCoordSeq_copyFromBuffer_r(
        context_, numbers.data(), static_cast<unsigned>(ring.size() + 1), 0, 0);
    GEOSGeometry* const result = GEOSGeom_createLinearRing_r(context_, sequence);
    return checked(result, result != nullptr, "making a ring");
}

GEOSGeometry* Geos::area_of(const std::vector<Ring>& rings, const Placement& place) {
    std::vector<GEOSGeometry*> holes;
    for (std::size_t ring = 1; ring < rings.size(); ++ring) {
        holes.push_back(ring_of(rings[ring], place));
    }
    GEOSGeometry* const result = GEOSGeom_createPolygon_r(
        context_, ring_of(rings.front(), place), holes.data(), static_cast<unsigned>(holes.size()));
    return checked(result, result != nullptr, "making a polygon");
}

void Geos::build(const Problem& problem, std::span<const PlacedShape> shapes) {
    clear();
    const Task task = problem.task;
    const bool needs_line = task == Task::vertex_penetration ||
                            task == Task::boundary_penetration || task == Task::field;
    if (problem.is_of_world()) {
        tree_ = GEOSSTRtree_create_r(context_, 10);
    }
    shapes_.reserve(shapes.size());  // the tree refers to them
    for (const PlacedShape& placed : shapes) {
        Shape& shape = shapes_.emplace_back();
        shape.context = context_;
        shape.area = area_of(placed.rings, Placement({}));
        if (task != Task::common_area) {
            shape.prepared_area = GEOSPrepare_r(context_, shape.area);
        }
        if (needs_line) {
            shape.line = GEOSBoundary_r(context_, shape.area);
            shape.prepared_line = GEOSPrepare_r(context_, shape.line);
        }
        if (tree_ != nullptr) {
            GEOSSTRtree_insert_r(context_, tree_, shape.area, &shape);
        }
    }
}

bool Geos::is_inside(std::size_t shape, Vector2 point) {
    GEOSGeometry* const geometry = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
    const char inside = GEOSPreparedContains_r(context_, shapes_[shape].prepared_area, geometry);
    GEOSGeom_destroy_r(context_, geometry);
    return checked(inside == 1, inside != 2, "contains");
}

double Geos::distance(const GEOSPreparedGeometry* from, const GEOSGeometry* to) const {
    double distance = 0.0;
    const int done = GEOSPreparedDistance_r(context_, from, to, &distance);
    return checked(distance, done == 1, "distance");
}

double Geos::distance_to_boundary(std::size_t shape, Vector2 point) {
    GEOSGeometry* const geometry = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
    const double least = distance(shapes_[shape].prepared_line, geometry);
    GEOSGeom_destroy_r(context_, geometry);
    return least;
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

bool Geos::meets(const GEOSGeometry* item) const {
    struct Search {
        const GEOSGeometry* item;
        bool found;
    } search{item, false};
    const auto use = [](void* found, void* data) {
        const Shape& shape = *static_cast<Shape*>(found);
        Search& of = *static_cast<Search*>(data);
        of.found =
            of.found || GEOSPreparedIntersects_r(shape.context, shape.prepared_area, of.item) == 1;
    };
    GEOSSTRtree_query_r(context_, tree_, item, use, &search);
    return search.found;
}

double Geos::least_distance(const GEOSGeometry* item) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& shape : shapes_) {
        least = std::min(least, distance(shape.prepared_area, item));
    }
    return least;
}

const Geos::Shape& Geos::nearest(const GEOSGeometry* item) const {
    // One of the two is the item, which is no Shape of the tree.
    const auto measure = [](const void* first, const void* second, double* distance, void* data) {
        const Shape& asked = *static_cast<const Shape*>(data);
        const void* const other = first == &asked ? second : first;
        const Shape& shape = *static_cast<const Shape*>(other);
        return GEOSPreparedDistance_r(shape.context, shape.prepared_area, asked.area, distance);
    };
    Shape of_item{context_, const_cast<GEOSGeometry*>(item)};
    const void* const found =
        GEOSSTRtree_nearest_generic_r(context_, tree_, &of_item, item, measure, &of_item);
    return *static_cast<const Shape*>(found);
}

void Geos::ask_world(const Problem& problem, std::vector<double>& numbers) {
    const std::vector<Ring> rings = problem.item();
    for (const Pose& pose : problem.request().poses) {
        GEOSGeometry* const item = area_of(rings, Placement(pose));
        numbers.push_back(problem.task == Task::pose_distances ? least_distance(item)
                          : meets(item)                        ? 1.0
                                                               : 0.0);
        GEOSGeom_destroy_r(context_, item);
    }
    for (const Vector2& point : problem.request().points) {
        GEOSGeometry* const item = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
        numbers.push_back(distance(nearest(item).prepared_area, item));
        GEOSGeom_destroy_r(context_, item);
    }
}

}  // namespace

std::unique_ptr<Peer> make_geos_peer() {
    return std::make_unique<Geos>();
}

}  // namespace nearfield::peers
