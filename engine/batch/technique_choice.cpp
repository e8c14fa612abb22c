#include <engine/base/interruption.hpp>
#include <engine/batch/technique_choice.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/queries/field_parts.hpp>
#include <engine/queries/grid.hpp>

#include <shaders/fields.h>

#include <cmath>
#include <numbers>

namespace nearfield::batch {
namespace {

using geometry::Box;

/// Whether the shapes take more of a storage buffer than there is, so that compute refuses an
/// intersection.
bool exceed_buffer(const AnyQuery& query, const queries::QueryShapes& shapes, std::uint64_t range) {
    return std::holds_alternative<IntersectionQuery>(query) && shapes.a != nullptr &&
           shapes.b != nullptr && queries::max_shape_bytes(*shapes.a, *shapes.b) > range;
}

/// Around a shape at its pose, from its radius.
Box box_around(const geometry::Polygon& polygon, const Pose& pose, double grow) {
    const geometry::Vector reach = geometry::Vector::Constant(polygon.radius() + grow);
    const geometry::Vector center = geometry::TransformedPolygon(polygon, pose).translation();
    return {center - reach, center + reach};
}

/// As many as its grid has, or more where its rectangle follows from the shapes.
double cells_of(const DistanceFieldQuery& query, const queries::QueryShapes& shapes) {
    if (!query.values && !query.features && !query.gradients) {
        return static_cast<double>(query.points.size()) *
               queries::field_parts(query).cells_per_point;
    }
    Box box;
    if (query.rectangle) {
        box = {geometry::to_vector(query.rectangle->min),
               geometry::to_vector(query.rectangle->max)};
    } else if (shapes.a != nullptr && shapes.b != nullptr) {
        box = box_around(*shapes.a, query.a.pose, query.tolerance)
                  .intersection(box_around(*shapes.b, query.b.pose, query.tolerance));
    }
    const double cell = query.tolerance * std::numbers::sqrt2;
    // The numbers of a query that will be rejected may be anything.
    const bool is_grid = !box.isEmpty() && std::isfinite(box.sizes().sum() / cell);
    return is_grid ? queries::Grid::covering(box, cell).cells() : 0.0;
}

bool can(Technique technique, const AnyQuery& query, const TechniqueRule& rule) {
    return rule.available.has(technique) && queries::is_candidate(technique, query);
}

/// Whether compute may be quicker than the CPU, and refuses nothing that the CPU answers.
bool may_be_compute(const AnyQuery& query, const queries::QueryShapes& shapes,
                    const TechniqueRule& rule) {
    if (!can(Technique::compute, query, rule) || exceed_buffer(query, shapes, rule.largest_range)) {
        return false;
    }
    // Which edges are about equally near to a cell is found while compute answers.
    if (std::holds_alternative<DistanceFieldQuery>(query)) {
        return shapes.b == nullptr || shapes.b->size() <= shaders::max_certain_edges;
    }
    // The CPU takes the gradients in any case.
    const auto* const contacts = std::get_if<ContactQuery>(&query);
    return contacts == nullptr || contacts->normals == ContactNormals::analytic;
}

/// For what the CPU does not answer; automatic if no other technique does.
Technique among_devices(const AnyQuery& query, const queries::QueryShapes& shapes,
                        const TechniqueRule& rule) {
    const bool draws = can(Technique::raster, query, rule);
    const bool is_refused = exceed_buffer(query, shapes, rule.largest_range);
    if (can(Technique::compute, query, rule) && !(draws && is_refused)) {
        return Technique::compute;
    }
    return draws ? Technique::raster : Technique::automatic;
}

bool is_automatic(const AnyQuery& query) {
    return std::visit([](const auto& asked) { return asked.technique; }, query) ==
           Technique::automatic;
}

/// Whether there is enough work for compute, of queries between two shapes and of fields.
struct IsEnough {
    bool pairs = false;
    bool cells = false;
};

IsEnough is_enough(std::span<const AnyQuery> queries, std::span<const queries::QueryShapes> shapes,
                   const TechniqueRule& rule) {
    if (!rule.thresholds) {
        return {};
    }
    double pairs = 0.0;
    double cells = 0.0;
    SparseCheckpoint<256> checkpoint;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        checkpoint.step();
        if (!is_automatic(queries[i]) || !may_be_compute(queries[i], shapes[i], rule)) {
            continue;
        }
        if (const auto* const field = std::get_if<DistanceFieldQuery>(&queries[i])) {
            cells += cells_of(*field, shapes[i]);
        } else {
            pairs += 1.0;
        }
    }
    return {pairs >= static_cast<double>(rule.thresholds->pairs),
            cells >= static_cast<double>(rule.thresholds->cells)};
}

}  // namespace

void choose_techniques(std::span<AnyQuery> queries, std::span<const queries::QueryShapes> shapes,
                       const TechniqueRule& rule) {
    const IsEnough enough = is_enough(queries, shapes, rule);
    SparseCheckpoint<256> checkpoint;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        checkpoint.step();
        AnyQuery& query = queries[i];
        if (!is_automatic(query)) {
            continue;
        }
        Technique technique = Technique::cpu;
        if (!can(Technique::cpu, query, rule)) {
            technique = among_devices(query, shapes[i], rule);
        } else if (std::holds_alternative<DistanceFieldQuery>(query) ? enough.cells
                                                                     : enough.pairs) {
            technique = may_be_compute(query, shapes[i], rule) ? Technique::compute : technique;
        }
        std::visit([technique](auto& asked) { asked.technique = technique; }, query);
    }
}

}  // namespace nearfield::batch
