#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

namespace nearfield::select {

/// The estimated work of a query.
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

/// Lower and upper bounds on the work of a query.
struct WorkBounds {
    Work least;
    Work most;

    /// The most microseconds that a device can save over the CPU, without submissions.
    [[nodiscard]] double max_saved(const TechniqueCost& cpu, const TechniqueCost& device) const;
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
