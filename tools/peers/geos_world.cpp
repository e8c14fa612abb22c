#include <geos_c.h>
#include <tools/peers/world_contest.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace nearfield::peers {
namespace {

/// GEOS: an STRtree over prepared geometries.
class GeosWorld final : public WorldPeer {
public:
    GeosWorld() : context_(GEOS_init_r()) {}
    ~GeosWorld() override;
    GeosWorld(const GeosWorld&) = delete;
    GeosWorld& operator=(const GeosWorld&) = delete;

    [[nodiscard]] std::string name() const override { return "GEOS"; }
    [[nodiscard]] std::string how(const WorldProblem& problem) const override;
    void build(const WorldProblem& problem) override;
    void answer(const WorldProblem& problem, std::vector<double>& answers) override;

private:
    struct Shape {
        GEOSContextHandle_t context = nullptr;
        GEOSGeometry* geometry = nullptr;
        const GEOSPreparedGeometry* prepared = nullptr;
    };

    [[nodiscard]] GEOSGeometry* geometry_of(const std::vector<Ring>& rings, const Pose& pose) const;
    [[nodiscard]] GEOSGeometry* ring_of(const Ring& ring, const Pose& pose) const;
    [[nodiscard]] bool meets(const GEOSGeometry* item) const;
    [[nodiscard]] double distance(const GEOSGeometry* item) const;
    [[nodiscard]] const Shape& nearest(const GEOSGeometry* item) const;

    GEOSContextHandle_t context_;
    GEOSSTRtree* tree_ = nullptr;
    std::vector<Shape> shapes_;
};

GeosWorld::~GeosWorld() {
    if (tree_ != nullptr) {
        GEOSSTRtree_destroy_r(context_, tree_);
    }
    for (const Shape& shape : shapes_) {
        GEOSPreparedGeom_destroy_r(context_, shape.prepared);
        GEOSGeom_destroy_r(context_, shape.geometry);
    }
    GEOS_finish_r(context_);
}

std::string GeosWorld::how(const WorldProblem& problem) const {
    if (!problem.segments.empty()) {
        return {};
    }
    if (!problem.points.empty()) {
        return "STRtree nearest with prepared distance; a distance alone";
    }
    return problem.asks_distances ? "prepared distance to each of the shapes; a distance alone"
                                  : "STRtree query, prepared intersects";
}

GEOSGeometry* GeosWorld::ring_of(const Ring& ring, const Pose& pose) const {
    const auto size = static_cast<unsigned>(ring.size());
    GEOSCoordSequence* const sequence = GEOSCoordSeq_create_r(context_, size + 1, 2);
    for (unsigned i = 0; i <= size; ++i) {
        const Vector2 at = at_pose(ring[i % size], pose);
        GEOSCoordSeq_setXY_r(context_, sequence, i, at.x, at.y);
    }
    return GEOSGeom_createLinearRing_r(context_, sequence);
}

/// The first ring with the others as holes, or separate parts if they are not inside it.
GEOSGeometry* GeosWorld::geometry_of(const std::vector<Ring>& rings, const Pose& pose) const {
    std::vector<GEOSGeometry*> parts;
    for (const Ring& ring : rings) {
        parts.push_back(GEOSGeom_createPolygon_r(context_, ring_of(ring, pose), nullptr, 0));
    }
    GEOSGeometry* geometry = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        GEOSGeometry* const joined = GEOSSymDifference_r(context_, geometry, parts[i]);
        GEOSGeom_destroy_r(context_, geometry);
        GEOSGeom_destroy_r(context_, parts[i]);
        geometry = joined;
    }
    if (geometry == nullptr) {
        throw std::runtime_error("GEOS cannot make a geometry");
    }
    return geometry;
}

void GeosWorld::build(const WorldProblem& problem) {
    tree_ = GEOSSTRtree_create_r(context_, 10);
    shapes_.reserve(problem.shapes.size());
    for (const WorldShape& shape : problem.shapes) {
        GEOSGeometry* const geometry = geometry_of(shape.rings, shape.pose);
        shapes_.push_back({context_, geometry, GEOSPrepare_r(context_, geometry)});
        GEOSSTRtree_insert_r(context_, tree_, geometry, &shapes_.back());
    }
}

bool GeosWorld::meets(const GEOSGeometry* item) const {
    struct Search {
        const GEOSGeometry* item;
        bool found;
    } search{item, false};
    const auto use = [](void* found, void* data) {
        const Shape& shape = *static_cast<Shape*>(found);
        Search& of = *static_cast<Search*>(data);
        of.found =
            of.found || GEOSPreparedIntersects_r(shape.context, shape.prepared, of.item) == 1;
    };
    GEOSSTRtree_query_r(context_, tree_, item, use, &search);
    return search.found;
}

double GeosWorld::distance(const GEOSGeometry* item) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& shape : shapes_) {
        double distance = 0.0;
        GEOSPreparedDistance_r(context_, shape.prepared, item, &distance);
        least = std::min(least, distance);
    }
    return least;
}

const GeosWorld::Shape& GeosWorld::nearest(const GEOSGeometry* item) const {
    // One of the two is the item, which is no Shape of the tree.
    const auto measure = [](const void* first, const void* second, double* distance, void* data) {
        const Shape& asked = *static_cast<const Shape*>(data);
        const void* const other = first == &asked ? second : first;
        const Shape& shape = *static_cast<const Shape*>(other);
        return GEOSPreparedDistance_r(shape.context, shape.prepared, asked.geometry, distance);
    };
    Shape of_item{context_, const_cast<GEOSGeometry*>(item), nullptr};
    const void* const found =
        GEOSSTRtree_nearest_generic_r(context_, tree_, &of_item, item, measure, &of_item);
    return *static_cast<const Shape*>(found);
}

void GeosWorld::answer(const WorldProblem& problem, std::vector<double>& answers) {
    answers.clear();
    for (const Pose& pose : problem.poses) {
        GEOSGeometry* const item = geometry_of(problem.item, pose);
        answers.push_back(problem.asks_distances ? distance(item) : meets(item) ? 1.0 : 0.0);
        GEOSGeom_destroy_r(context_, item);
    }
    for (const Vector2& point : problem.points) {
        GEOSGeometry* const item = GEOSGeom_createPointFromXY_r(context_, point.x, point.y);
        double distance = 0.0;
        GEOSPreparedDistance_r(context_, nearest(item).prepared, item, &distance);
        answers.push_back(distance);
        GEOSGeom_destroy_r(context_, item);
    }
}

}  // namespace

std::unique_ptr<WorldPeer> make_geos_world() {
    return std::make_unique<GeosWorld>();
}

}  // namespace nearfield::peers
