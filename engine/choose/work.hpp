#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

namespace nearfield::choose {

/// What a query comes to, as far as that can be told without answering it.
struct Work {
    WorkCost TechniqueCost::*kind = &TechniqueCost::points;
    double edges = 0.0;
    double samples = 0.0;

    /// Microseconds by a technique, without its submission.
    [[nodiscard]] double time(const TechniqueCost& costs) const {
        const WorkCost& cost = costs.*kind;
        return cost.query + cost.edge * edges + cost.sample * samples;
    }
};

/// What a query comes to at the least and at the most.
struct WorkBounds {
    Work least;
    Work most;

    /// How many microseconds less it can take by a device than by the CPU, submissions left out.
    [[nodiscard]] double most_saved(const TechniqueCost& cpu, const TechniqueCost& device) const;
};

// `a` is null where the query has none. The query's numbers need not be good: of a query that will
// be refused anything may be returned.

/// Looks at no vertex. The samples of vertices and of fields over a rectangle are told exactly.
[[nodiscard]] WorkBounds work_bounds(const AnyQuery& query, const geometry::Polygon* a,
                                     const geometry::Polygon& b);

/// Within the bounds. Looks at some dozens of vertices, and at all of a thousand for a box,
/// whatever the size of the shapes.
[[nodiscard]] Work work_of(const AnyQuery& query, const geometry::Polygon* a,
                           const geometry::Polygon& b);

}  // namespace nearfield::choose
