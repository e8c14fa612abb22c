#pragma once

#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

/// \file
/// What comes back. Points and directions are in world coordinates, lengths in world units.

namespace nearfield {

/// A rectangle that localisation found, with the grid it was sampled on. Sample (column, row) is
/// the centre of its cell: min + (column + 1/2, row + 1/2) * cell; row 0 is the lowest.
struct Region {
    Vector2 min;
    Vector2 max;
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
};

/// What every result says.
struct ResultSummary {
    Status status;             ///< of this query alone; the rest is meaningful only where it is ok
    double tolerance = 0.0;    ///< d as asked
    double error_bound = 0.0;  ///< what the result's own description says it bounds; at most d
    /// The closed shapes share a point; containment and touching count. False for a distance field
    /// without a shape A.
    bool intersects = false;
    double cell = 0.0;  ///< side of a grid cell
    std::vector<Region> regions;
};

/// A part of a boundary: an edge without its end points, or a vertex. Indices count through all
/// rings of the shape in the order given.
struct Feature {
    enum class Kind : std::uint8_t { edge, vertex };
    Kind kind = Kind::edge;
    std::uint32_t index = 0;
};

/// One penetrating point of A.
struct PenetrationRecord {
    Vector2 point;       ///< on A's boundary, inside B
    double depth = 0.0;  ///< distance from `point` to `nearest`, > 0
    Vector2 direction;   ///< unit vector from `point` to `nearest`: the way out
    Vector2 nearest;     ///< the point of B's boundary nearest to `point`
    Feature feature;     ///< of B: where `nearest` lies
    /// False where the direction is one of several: B's boundary holds another point no farther
    /// than `depth` + d/1000 that is not just a little way along the same wall, which is to say
    /// farther from `nearest` than twice what a straight wall would explain, 2 * sqrt((depth +
    /// d/1000)^2 - depth^2).
    bool unique = true;
};

/// Answer to a PenetrationQuery.
///
/// Each record's numbers are computed in double precision from the vertices as given. Which feature
/// is nearest is decided in single precision in grid cells: where two are equally near to within
/// d/1000, either may be named. `error_bound` bounds how much deeper than `deepest` any point of
/// A's boundary can be (any vertex, for PenetrationPoints::vertices).
struct PenetrationResult : ResultSummary {
    std::uint32_t count = 0;                 ///< penetrating points found
    PenetrationRecord deepest;               ///< meaningful where count > 0
    std::vector<PenetrationRecord> records;  ///< in order along A's rings
};

/// One grid sample that lies in both shapes.
struct IntersectionSample {
    static constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
    Vector2 point;                 ///< the centre of a cell
    std::uint32_t edge = no_edge;  ///< where A takes part by its boundary: an edge of A nearby
};

/// Answer to an IntersectionQuery.
///
/// `error_bound`: every sample is within it of both shapes, and every point that is deeper than it
/// in both (or, by its boundary, lies on it) has a sample within it.
struct IntersectionResult : ResultSummary {
    IntersectionKind kind = IntersectionKind::volume_volume;
    std::uint64_t count = 0;                  ///< samples found
    double area = 0.0;                        ///< count times the area of a cell
    std::vector<IntersectionSample> samples;  ///< by region, then row by row from the low corner
};

/// The field at one of DistanceFieldQuery::points.
struct FieldPoint {
    Vector2 point;
    /// Signed distance: bilinear between the four cell centres around the point.
    double distance = 0.0;
    /// The exact signed distance differs from `distance` by no more than this. A distance changes
    /// by no more than the way walked, so each of the four cells confines it; this is what all four
    /// leave open, at most DistanceFieldResult::error_bound + d.
    double error_bound = 0.0;
    /// The sign, 0 outside and 1 inside, bilinear between the same four cells: more than 0.5 is
    /// negative. Right wherever the boundary is farther than 1.0824 d + the result's error_bound.
    double inside = 0.0;
    /// By DistanceFieldQuery::gradient. Analytic: at the point itself, from `feature`. The others:
    /// bilinear between the gradients of the four cells.
    Vector2 gradient;
    Feature feature;     ///< of B's boundary, nearest to the point itself
    bool unique = true;  ///< as PenetrationRecord::unique, of `feature` and the analytic gradient
};

/// Answer to a DistanceFieldQuery. `error_bound` bounds the difference from the exact signed
/// distance at every cell centre that was read back.
///
/// What is asked for at every cell has width * height entries, row by row from the lowest, and is
/// empty where it was not asked for. Features are found among B's own edges. Which is nearest is
/// decided in single precision in grid cells: where two are equally near to within d/1000, or to
/// within 2^-18 of the distance where that is more, either may be named, and `unique` is 0.
struct DistanceFieldResult : ResultSummary {
    Vector2 origin;                    ///< low corner of cell (0, 0)
    std::uint32_t width = 0;           ///< cells along x
    std::uint32_t height = 0;          ///< cells along y
    std::vector<float> values;         ///< signed distance, negative inside B
    std::vector<Feature> features;     ///< of B's boundary, nearest to the centre
    std::vector<float> gradients;      ///< x and y of each cell, one after the other
    std::vector<std::uint8_t> unique;  ///< 1 or 0; with features or analytic gradients
    std::vector<FieldPoint> points;    ///< in the order asked
    /// Bounds, for either component of a gradient at a cell, the difference from: the unit vector
    /// between the centre and the nearest point of the feature named (analytic; on the boundary,
    /// its outward normal), central differences of the exact signed distance (the other methods). 0
    /// where no gradient was asked for.
    double gradient_error_bound = 0.0;
    /// The Vulkan format that a blended gradient went through ("R32G32_SFLOAT"); empty without one.
    const char* gradient_format = "";
};

/// Time one pass took on the device.
struct PassTime {
    std::string name;
    double milliseconds = 0.0;
};

/// Where the time of a batch went, in milliseconds.
struct Timings {
    double localize = 0.0;  ///< hierarchies on the CPU
    double plan = 0.0;      ///< simplification, meshes, atlas, upload
    double record = 0.0;    ///< commands
    double device = 0.0;    ///< from submission to fence
    double decode = 0.0;    ///< reading results and making them exact
    double total = 0.0;
    std::vector<PassTime> passes;  ///< by timestamps; empty where the queue has none
};

using AnyResult = std::variant<PenetrationResult, IntersectionResult, DistanceFieldResult>;

template <class Query>
struct ResultOf;
template <>
struct ResultOf<PenetrationQuery> {
    using type = PenetrationResult;
};
template <>
struct ResultOf<IntersectionQuery> {
    using type = IntersectionResult;
};
template <>
struct ResultOf<DistanceFieldQuery> {
    using type = DistanceFieldResult;
};

/// The results of one batch, in the order of its queries. Reusing one object for every frame keeps
/// its memory.
struct Results {
    std::vector<AnyResult> results;
    Timings timings;

    /// The result of a query. Precondition: the handle comes from the batch that was run.
    template <class Query>
    [[nodiscard]] const typename ResultOf<Query>::type& operator[](
        QueryHandle<Query> handle) const {
        return std::get<typename ResultOf<Query>::type>(results[handle.index]);
    }
};

}  // namespace nearfield
