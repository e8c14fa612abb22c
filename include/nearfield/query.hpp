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

/// Which buffer of the device says which cells lie inside (section 2.2.2 lists all three). They
/// give the same sign everywhere.
enum class SignEncoding {
    stencil,      ///< the stencil buffer, set to 1
    color,        ///< a colour buffer of its own, set to white
    feature_bit,  ///< the top bit of the feature id in the image of nearest features
};

/// How the gradient of the signed distance is found (section 2.2.3). Gradients point to where the
/// signed distance grows: away from B outside it, the way out inside.
enum class GradientMethod {
    /// From the nearest feature: the unit vector between a place and the nearest point of B's
    /// boundary. Exact to rounding; where several points are nearest it is one of several.
    analytic,
    /// Half the difference of the signed distances at the two neighbours, along x and along y.
    central_differences,
    /// The same, for the whole image in blended passes on the device, at the precision of a pixel.
    blended,
};

/// The signed distance field of B (section 2.2.2): distance to B's boundary at the centres of a
/// grid of cells, negative inside B; and what follows from it, the image of nearest features (the
/// Voronoi diagram) and the gradient (section 2.2.3). Refused where nothing is asked for.
struct DistanceFieldQuery {
    Instance a;  ///< whose box is shared; may be left out (the default) where a rectangle is given
    Instance b;
    double tolerance = 0.0;  ///< d, world units, > 0; the side of a cell is d * sqrt 2
    /// What the grid covers; its low corner is the low corner of cell (0, 0). Left out: what the
    /// bounding boxes of A and B have in common, grown by d on every side; an error where they have
    /// nothing in common.
    std::optional<Rectangle> rectangle = std::nullopt;
    SignEncoding sign = SignEncoding::stencil;
    /// Of the gradients asked for, at cells and at points.
    GradientMethod gradient = GradientMethod::analytic;
    bool values = true;      ///< the signed distance at every cell
    bool features = false;   ///< the nearest feature at every cell
    bool gradients = false;  ///< the gradient at every cell
    /// Places where distance, sign and gradient are reconstructed from the four cells around, world
    /// coordinates. Only those cells are read back for them. Each has to lie in the grid, edge
    /// included (reconstruction takes cells from a border around the grid). Borrowed until run()
    /// returns.
    std::span<const Vector2> points = {};
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
