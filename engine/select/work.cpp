#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/field_parts.hpp>
#include <engine/select/work.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace nearfield::select {
namespace {

using geometry::Box;
using geometry::grown;
using geometry::Polygon;
using geometry::TransformedPolygon;

// Number of vertices of a shape that an estimate samples: the differences between techniques exceed
// the uncertainty this leaves, and it takes less time than any answer. Of small shapes, whose
// answers take little, fewer.
constexpr std::uint32_t looked_at = 64;
constexpr std::uint32_t looked_at_of_small = 8;

std::uint32_t stride_of(const Polygon& polygon) {
    const std::uint32_t most = std::clamp(polygon.size() / 8, looked_at_of_small, looked_at);
    return (polygon.size() + most - 1) / most;
}

// Up to this many vertices, boxing all is faster than picking some.
constexpr std::uint32_t boxed_at_once = 1024;

/// The box of all vertices, or of a sample if there are very many.
Box rough_box(const TransformedPolygon& placed) {
    Box box;
    const Polygon& polygon = placed.polygon();
    if (polygon.size() <= boxed_at_once) {
        box = placed.box();
    } else {
        for (std::uint32_t i = 0; i < polygon.size(); i += stride_of(polygon)) {
            box.extend(placed.vertex(i));
        }
    }
    return box;
}

/// The number of samples, one cell apart, of the boundary within a box. `own`: its rough box.
double boundary_samples(const TransformedPolygon& placed, const Box& own, const Box& within,
                        double cell) {
    if (!own.intersects(within)) {
        return 0.0;
    }
    const Polygon& polygon = placed.polygon();
    const std::uint32_t stride = stride_of(polygon);
    double samples = 0.0;
    std::uint32_t ring = 0;
    for (std::uint32_t i = 0; i < polygon.size(); i += stride) {
        while (i >= polygon.ring_end(ring)) {
            ++ring;
        }
        const bool is_last = i + 1 == polygon.ring_end(ring);
        const geometry::Vector from = placed.vertex(i);
        const geometry::Vector to = placed.vertex(is_last ? polygon.ring_begin(ring) : i + 1);
        const Box edge(from.cwiseMin(to), from.cwiseMax(to));
        const Box inside = edge.intersection(within);
        if (!inside.isEmpty()) {
            samples += 1.0 + std::min(inside.diagonal().norm(), (to - from).norm()) / cell;
        }
    }
    return samples * stride;
}

double cells_of(const Box& box, double cell) {
    if (box.isEmpty()) {
        return 0.0;
    }
    const geometry::Vector sides = box.sizes() / cell;
    return (sides.x() + 1.0) * (sides.y() + 1.0);
}

/// The region where both shapes can be; rough boxes are slightly too small.
Box common_box(const TransformedPolygon& a, const TransformedPolygon& b, double grow) {
    return grown(rough_box(a), grow).intersection(grown(rough_box(b), grow));
}

/// The largest number of cells of a rectangle that both shapes can share, each grown.
double max_common_cells(const TransformedPolygon& a, const TransformedPolygon& b, double grow,
                        double cell) {
    const auto around = [grow](const TransformedPolygon& placed) {
        return grown(Box(placed.translation()), placed.polygon().radius() + grow);
    };
    return cells_of(around(a).intersection(around(b)), cell);
}

/// The weight of an edge that is only tested by its box.
constexpr double far_edge = 1.0 / 16.0;

/// The number of edges of a shape that an intersection processes.
double edges_in(const TransformedPolygon& placed, const Box& box) {
    const Polygon& polygon = placed.polygon();
    const std::uint32_t stride = stride_of(polygon);
    double near = 0.0;
    for (std::uint32_t i = 0; i < polygon.size() && !box.isEmpty(); i += stride) {
        near += box.contains(placed.vertex(i)) ? stride : 0.0;
    }
    return std::min<double>(near + far_edge * polygon.size(), polygon.size());
}

// Cells beside each other search together, in blocks of so many by so many.
constexpr double cells_together = 16.0;
// At most so many places by so many, which is enough for a mean.
constexpr double most_places = 5.0;

/// How many places along a side of a field tell what its cells have around them.
int places_along(double side, double cell) {
    const double blocks = side / (cells_together * cell);
    return static_cast<int>(blocks > 1.0 ? std::min(blocks, most_places) : 1.0);
}

/// The mean number of edges that are about as near to a place in the box as the nearest, of a shape
/// that is known by some of its vertices.
double edges_near(const TransformedPolygon& placed, const Box& box, double cell) {
    const Polygon& polygon = placed.polygon();
    std::array<geometry::Vector, looked_at> vertices;
    const std::uint32_t stride = stride_of(polygon);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < polygon.size(); i += stride) {
        vertices[count++] = placed.vertex(i);
    }
    if (count == 0 || box.isEmpty()) {
        return 1.0;
    }
    const geometry::Vector sides = box.sizes();
    const int columns = places_along(sides.x(), cell);
    const int rows = places_along(sides.y(), cell);
    const double reach = cells_together * std::numbers::sqrt2 * cell;
    std::uint32_t near = 0;
    for (int place = 0; place < columns * rows; ++place) {
        const int column = place % columns;
        const int row = place / columns;
        const geometry::Vector at =
            box.min() +
            geometry::Vector(sides.x() * (column + 0.5) / columns, sides.y() * (row + 0.5) / rows);
        std::array<double, looked_at> squares;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < count; ++i) {
            squares[i] = (vertices[i] - at).squaredNorm();
            least = std::min(least, squares[i]);
        }
        const double distance = std::sqrt(least) + reach;
        for (std::uint32_t i = 0; i < count; ++i) {
            near += squares[i] <= distance * distance ? 1U : 0U;
        }
    }
    return static_cast<double>(near) * stride / (columns * rows);
}

/// Upper bound on boundary_samples().
double max_boundary_samples(const Polygon& polygon, double cell) {
    return polygon.size() + polygon.length_along_axes() / cell;
}

double cell_of(double tolerance) {
    return tolerance * std::numbers::sqrt2;
}

/// Bounds computed without reading a vertex.
struct Bounds {
    const Polygon* a;
    const Polygon& b;
    WorkCost QueryCosts::*kind;

    [[nodiscard]] double edges() const {
        return static_cast<double>(b.size()) +
               (a == nullptr ? 0.0 : static_cast<double>(a->size()));
    }
    [[nodiscard]] WorkBounds of(double least, double most) const {
        return {{kind, edges(), least}, {kind, edges(), most}};
    }

    WorkBounds operator()(const PenetrationQuery& query) const {
        if (query.points == PenetrationPoints::vertices) {
            return of(a->size(), a->size());
        }
        return of(0.0, max_boundary_samples(*a, cell_of(query.tolerance)));
    }

    WorkBounds operator()(const ContactQuery& query) const {
        const double cell = cell_of(query.tolerance);
        return of(0.0, max_boundary_samples(*a, cell) + max_boundary_samples(b, cell));
    }

    WorkBounds operator()(const IntersectionQuery& query) const {
        const double most =
            max_common_cells(TransformedPolygon(*a, query.a.pose),
                             TransformedPolygon(b, query.b.pose), 0.0, cell_of(query.tolerance));
        WorkBounds bounds = of(0.0, most);
        bounds.least.edges *= far_edge;
        return bounds;
    }

    WorkBounds operator()(const DistanceFieldQuery& query) const {
        const plan::FieldParts parts = plan::field_parts(query);
        const double cell = cell_of(query.tolerance);
        double least = 0.0;
        double most = 0.0;
        if (!query.values && !query.features && !query.gradients) {
            least = most = static_cast<double>(query.points.size() * parts.cells_per_point);
        } else if (query.rectangle) {
            least = most = cells_of(Box(geometry::to_vector(query.rectangle->min),
                                        geometry::to_vector(query.rectangle->max)),
                                    cell);
        } else if (a != nullptr) {
            most = max_common_cells(TransformedPolygon(*a, query.a.pose),
                                    TransformedPolygon(b, query.b.pose), query.tolerance, cell);
        }
        // Only A's box is used.
        Work work{kind, static_cast<double>(b.size()), least};
        work.is_read = parts.host_values || parts.host_features || !query.points.empty();
        WorkBounds bounds{work, work};
        bounds.most.samples = most;
        bounds.least.searches = least;  // one edge is the nearest
        bounds.most.searches = most * std::log2(1.0 + work.edges);
        return bounds;
    }

    template <class Query>
    WorkBounds operator()(const Query& /*query*/) const {
        return of(0.0, 0.0);
    }
};

/// The work of a query whose bounds leave it open.
struct Estimate {
    const Polygon* a;
    const Polygon& b;
    Work work;  // upper bound

    Work operator()(const PenetrationQuery& query) {
        const TransformedPolygon placed(*a, query.a.pose);
        const Box within = rough_box(TransformedPolygon(b, query.b.pose));
        return with_samples(
            boundary_samples(placed, rough_box(placed), within, cell_of(query.tolerance)));
    }

    Work operator()(const ContactQuery& query) {
        const TransformedPolygon transformed_a(*a, query.a.pose);
        const TransformedPolygon transformed_b(b, query.b.pose);
        const double cell = cell_of(query.tolerance);
        const Box box_a = rough_box(transformed_a);
        const Box box_b = rough_box(transformed_b);
        const double reach = query.contact_distance;
        return with_samples(boundary_samples(transformed_a, box_a, grown(box_b, reach), cell) +
                            boundary_samples(transformed_b, box_b, grown(box_a, reach), cell));
    }

    Work operator()(const IntersectionQuery& query) {
        const TransformedPolygon transformed_a(*a, query.a.pose);
        const TransformedPolygon transformed_b(b, query.b.pose);
        const Box box = common_box(transformed_a, transformed_b, 0.0);
        work.edges = edges_in(transformed_a, box) + edges_in(transformed_b, box);
        return with_samples(cells_of(box, cell_of(query.tolerance)));
    }

    Work operator()(const DistanceFieldQuery& query) {
        const TransformedPolygon transformed_b(b, query.b.pose);
        const double cell = cell_of(query.tolerance);
        Box box;
        if (query.rectangle) {
            box = Box(geometry::to_vector(query.rectangle->min),
                      geometry::to_vector(query.rectangle->max));
        } else if (a != nullptr) {
            box = common_box(TransformedPolygon(*a, query.a.pose), transformed_b, query.tolerance);
            work = with_samples(cells_of(box, cell));
        }
        const double search = std::log2(1.0 + edges_near(transformed_b, box, cell));
        work.searches = std::min(work.searches, work.samples * search);
        return work;
    }

    template <class Query>
    Work operator()(const Query& /*query*/) {
        return work;  // its bounds are exact
    }

private:
    Work with_samples(double samples) {
        work.samples = std::min(samples, work.samples);
        return work;
    }
};

}  // namespace

WorkCost QueryCosts::*kind_of(const AnyQuery& query) {
    return std::visit(
        []<class Query>(const Query& asked) -> WorkCost QueryCosts::* {
            if constexpr (std::is_same_v<Query, PenetrationQuery> ||
                          std::is_same_v<Query, ContactQuery>) {
                return &QueryCosts::points;
            } else if constexpr (std::is_same_v<Query, IntersectionQuery>) {
                return &QueryCosts::intersection;
            } else if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
                return plan::field_parts(asked).features ? &QueryCosts::features
                                                         : &QueryCosts::field;
            } else {
                // Separations, tests, and queries that only one technique answers, too.
                return &QueryCosts::closest;
            }
        },
        query);
}

double WorkBounds::max_saved(const QueryCosts& cpu, const QueryCosts& device) const {
    const WorkCost& by_cpu = cpu.*most.kind;
    const WorkCost& by_device = device.*most.kind;
    // Whatever the work, it is the same for both.
    const auto saved = [&](double WorkCost::*cost, double Work::*part) {
        const double each = by_cpu.*cost - by_device.*cost;
        return each * (each > 0.0 ? most.*part : least.*part);
    };
    return std::max(0.0, by_cpu.query - by_device.query + saved(&WorkCost::edge, &Work::edges) +
                             saved(&WorkCost::sample, &Work::samples) +
                             saved(&WorkCost::search, &Work::searches) +
                             saved(&WorkCost::shape, &Work::shape_edges));
}

WorkBounds work_bounds(const AnyQuery& query, const Polygon* a, const Polygon& b) {
    return std::visit(Bounds{a, b, kind_of(query)}, query);
}

Work work_of(const AnyQuery& query, const Polygon* a, const Polygon& b) {
    const WorkBounds bounds = work_bounds(query, a, b);
    const bool open = bounds.least.samples < bounds.most.samples ||
                      bounds.least.edges < bounds.most.edges ||
                      bounds.least.searches < bounds.most.searches;
    return open ? std::visit(Estimate{a, b, bounds.most}, query) : bounds.most;
}

}  // namespace nearfield::select
