#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

/// \file
/// What can be asked. Queries are collected in a Batch; one batch is one unit of work.

namespace nearfield {

/// The part of a query's tolerance that the deviations of its shapes (Context::add_shape) may take
/// up, together; a query where they take more is refused.
inline constexpr double most_deviation = 0.25;

/// Which points of A a penetration query looks at.
enum class PenetrationPoints {
    boundary,  ///< samples along A's boundary, consecutive ones at most one cell (d * sqrt 2) apart
    vertices,  ///< A's own vertices
};

/// Point depth: for points of A's boundary inside B, the distance and direction to the nearest
/// point of B's boundary (the paper's section 2.2.4, "Penetration Depth and Direction").
struct PenetrationQuery {
    Instance a;
    Instance b;
    double tolerance = 0.0;  ///< d, world units, > 0: half the diagonal of a grid cell
    PenetrationPoints points = PenetrationPoints::boundary;
    bool records = true;  ///< false: keep the summary (count, deepest) and leave the records out
};

/// What of each shape takes part in an intersection (the paper's section 2.2.1).
enum class IntersectionKind {
    boundary_boundary,  ///< the boundary of A and the boundary of B
    boundary_volume,    ///< the boundary of A and the interior of B
    volume_volume,      ///< the interior of A and the interior of B
};

/// The samples of a grid that lie in both shapes (section 2.2.1, Table 1).
struct IntersectionQuery {
    Instance a;
    Instance b;
    double tolerance = 0.0;  ///< d, world units, > 0
    IntersectionKind kind = IntersectionKind::volume_volume;
    bool records = true;  ///< false: keep the summary (count, area) and leave the samples out
};

/// The signed distance field of B (section 2.2.2): distance to B's boundary at the centres of a
/// grid of cells, negative inside B.
struct DistanceFieldQuery {
    Instance a;  ///< whose box is shared; may be left out (the default) where a rectangle is given
    Instance b;
    double tolerance = 0.0;  ///< d, world units, > 0; the side of a cell is d * sqrt 2
    /// What the grid covers; its low corner is the low corner of cell (0, 0). Left out: what the
    /// bounding boxes of A and B have in common, grown by d on every side; an error where they have
    /// nothing in common.
    std::optional<Rectangle> rectangle;
};

/// Names a query of a batch and, by its type, the kind of result it has.
template <class Query>
struct QueryHandle {
    std::uint32_t index = UINT32_MAX;
};

using AnyQuery = std::variant<PenetrationQuery, IntersectionQuery, DistanceFieldQuery>;

/// An ordered list of queries. Clearing keeps the memory, so a batch that is filled anew each
/// frame does not allocate. Not thread-safe; different batches are independent.
class Batch {
public:
    template <class Query>
    QueryHandle<Query> add(const Query& query) {
        queries_.emplace_back(query);
        return {static_cast<std::uint32_t>(queries_.size() - 1)};
    }

    void clear() noexcept { queries_.clear(); }
    [[nodiscard]] std::span<const AnyQuery> queries() const noexcept { return queries_; }

private:
    std::vector<AnyQuery> queries_;
};

}  // namespace nearfield
