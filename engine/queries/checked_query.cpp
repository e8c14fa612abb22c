#include <engine/queries/boundary_points.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/queries/empty_result.hpp>

#include <shaders/search.h>

#include <type_traits>
#include <utility>
#include <variant>

namespace nearfield::queries {
namespace {

/// Only the box of a distance field's A is used.
template <class Query>
constexpr bool is_of_b_alone = std::is_same_v<Query, DistanceFieldQuery>;

template <class Query>
Status check_with_shapes(const Query& query, const QueryShapes& shapes, const QueryLimits& limits) {
    if (Status status = check_query(query, limits.techniques); !status.ok()) {
        return status;
    }
    const bool a_left_out = is_of_b_alone<Query> && query.a.shape == ShapeHandle{};
    if (shapes.a == nullptr && !a_left_out) {
        return limits.shape_errors->unknown("shape A", query.a.shape);
    }
    return shapes.b == nullptr ? limits.shape_errors->unknown("shape B", query.b.shape) : Status();
}

/// How a query spends its tolerance; nothing where it has none.
template <class Query>
ErrorBudget budget_of(const Query& query, const CheckedQuery& checked, const QueryLimits& limits) {
    // The CPU's answers must not depend on the device.
    const geometry::SubpixelGrid grid =
        checked.technique == Technique::cpu ? geometry::cpu_grid : limits.subpixel;
    if constexpr (std::is_same_v<Query, PenetrationQuery>) {
        return penetration_budget(query, checked.deviations);
    } else if constexpr (std::is_same_v<Query, ContactQuery>) {
        return contact_budget(query.tolerance, checked.deviations);
    } else if constexpr (is_left_to_cpu_by_compute<Query>) {
        return search_budget(query.tolerance);
    } else if constexpr (std::is_same_v<Query, IntersectionQuery>) {
        return intersection_budget(query, grid, checked.deviations);
    } else if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
        return field_budget(query, grid, checked.deviations);
    } else {
        return {};
    }
}

/// The technique that answers. Compute leaves closest pairs to the CPU, and boundaries that its
/// search for points does not take.
template <class Query>
Technique technique_of(const Query& query, const CheckedQuery& checked, const QueryLimits& limits) {
    if (query.technique != Technique::compute) {
        return query.technique;
    }
    bool is_left_to_cpu = is_left_to_cpu_by_compute<Query>;
    if constexpr (std::is_same_v<Query, PenetrationQuery> || std::is_same_v<Query, ContactQuery>) {
        const double of_b = std::is_same_v<Query, ContactQuery>
                                ? max_samples(*checked.b, checked.budget.cell)
                                : 0.0;
        is_left_to_cpu =
            !query.on_device && (max_points(checked) + of_b > max_searched_points ||
                                 max_shape_bytes(*checked.a, *checked.b) > limits.largest_range);
    }
    return is_left_to_cpu ? Technique::cpu : Technique::compute;
}

template <class Query>
void fill(const Query& query, const QueryShapes& shapes, const QueryLimits& limits,
          CheckedQuery& checked) {
    checked.a = shapes.a;
    checked.b = shapes.b;
    checked.pose_a = query.a.pose;
    checked.pose_b = query.b.pose;
    checked.deviations = {is_of_b_alone<Query> ? 0.0 : shapes.a->deviation(),
                          shapes.b->deviation()};
    checked.technique = query.technique;
    checked.budget = budget_of(query, checked, limits);
    checked.technique = technique_of(query, checked, limits);
}

}  // namespace

double max_points(const CheckedQuery& query) {
    const auto* const penetration = std::get_if<PenetrationQuery>(query.query);
    return penetration != nullptr && penetration->points == PenetrationPoints::vertices
               ? static_cast<double>(query.a->size())
               : max_samples(*query.a, query.budget.cell);
}

std::uint64_t max_shape_bytes(const geometry::Polygon& polygon) {
    const std::uint64_t rings = polygon.ring_count();
    const std::uint64_t chunks = polygon.size() / shaders::chunk_size + rings;
    // Boxes of all levels, edges and their low parts, their numbers and places, starts of rings.
    const std::uint64_t units =
        shaders::units_of_header + chunks + chunks / (shaders::chunk_size - 1) + 16 +
        std::uint64_t{2} * shaders::chunk_size * chunks + 2 * (chunks / 4 + 1) + rings / 4 + 1;
    return units * shaders::bytes_of_unit;
}

bool check(std::uint32_t index, const AnyQuery& any, const QueryShapes& shapes,
           const QueryLimits& limits, CheckedQuery& checked, AnyResult& any_result) {
    return std::visit(
        [&]<class Query>(const Query& query) {
            auto& result = begin_result(query, any_result, true);
            // Success is not copied: thousands of queries have it in common.
            Status status = check_with_shapes(query, shapes, limits);
            if (!status.ok()) {
                result.status = std::move(status);
                if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
                    clear_cells(result);
                }
                return false;
            }
            checked.index = index;
            checked.query = &any;
            fill(query, shapes, limits, checked);
            result.error_bound = checked.budget.bound;
            result.cell = checked.budget.cell;
            return true;
        },
        any);
}

}  // namespace nearfield::queries
