#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/select/load.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>

namespace nearfield::select {

inline constexpr std::array<WorkCost QueryCosts::*, 5> kinds_of_work{
    &QueryCosts::points, &QueryCosts::closest, &QueryCosts::intersection, &QueryCosts::field,
    &QueryCosts::features};

/// The estimated work of a query.
struct Work {
    WorkCost QueryCosts::*kind = &QueryCosts::points;
    double edges = 0.0;
    double samples = 0.0;
    /// Of a distance field: the sum over its cells of the binary logarithm of 1 + the edges that
    /// are about as near to a cell as the nearest.
    double searches = 0.0;
    /// The edges of its shapes, each divided by the number of queries that share what preparing it
    /// takes.
    double shape_edges = 0.0;
    bool is_read = true;  ///< the host reads results that a device has made

    /// Microseconds.
    [[nodiscard]] double time(const QueryCosts& costs) const {
        const WorkCost& cost = costs.*kind;
        return cost.query + cost.edge * edges + cost.sample * samples + cost.search * searches +
               cost.shape * shape_edges;
    }
    /// Without submission and latency.
    [[nodiscard]] Load load(const DeviceCosts& costs) const {
        return {.alone = time(costs.plan) + (is_read ? time(costs.read) : 0.0),
                .device = time(costs.device)};
    }
    [[nodiscard]] Load load(const CpuCosts& costs) const {
        return {.alone = time(costs.plan), .cpu = time(costs.answer)};
    }
};

/// The kind of work that a query is.
[[nodiscard]] WorkCost QueryCosts::*kind_of(const AnyQuery& query);

/// Lower and upper bounds on the work of a query.
struct WorkBounds {
    Work least;
    Work most;

    /// The most microseconds that a device can save over the CPU, if a query takes the device's
    /// `device`.
    [[nodiscard]] double max_saved(const QueryCosts& cpu, const QueryCosts& device) const;
};

// `a` is null if the query has none. The query's numbers may be invalid: for a query that will be
// rejected the result is unspecified.

/// Reads no vertex. Exact for the samples of vertices and of fields over a rectangle.
[[nodiscard]] WorkBounds work_bounds(const AnyQuery& query, const geometry::Polygon* a,
                                     const geometry::Polygon& b);

/// An estimate within the bounds. Reads a few dozen vertices, and up to a thousand for a box,
/// whatever the size of the shapes.
[[nodiscard]] Work work_of(const AnyQuery& query, const geometry::Polygon* a,
                           const geometry::Polygon& b);

}  // namespace nearfield::select
