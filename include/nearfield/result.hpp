#pragma once

#include <nearfield/export.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result_summary.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

/// \file
/// The results. Points and directions are in world coordinates, lengths in world units. Signed
/// distances are negative inside a shape.

namespace nearfield {

/// One penetrating point of A.
struct PenetratingPoint {
    Vector2 position;    ///< on A's boundary, inside B
    double depth = 0.0;  ///< distance from `position` to `nearest`, > d/1024
    Vector2 direction;   ///< unit vector from `position` to `nearest`: points out of B
    Vector2 nearest;     ///< the point of B's boundary nearest to `position`
    Feature feature;     ///< of B: where `nearest` lies
    /// False if another direction is as good: the nearest point of another edge of B is within
    /// `depth` + d/1000 of `position`, and farther from `nearest` than 2 * sqrt((depth + d/1000)^2
    /// - depth^2), twice the distance possible on one straight edge.
    bool unique = true;
};

/// What a PenetrationResult states besides its summary and points.
struct PenetrationValues {
    std::uint32_t count = 0;   ///< number of penetrating points
    PenetratingPoint deepest;  ///< meaningful if count > 0
};

/// Answer to a PenetrationQuery.
///
/// The numbers of a point are computed in double precision from the vertices as given. The nearest
/// feature is decided in single precision in grid cells: if two are equally near to within d/1000,
/// either may be named.
///
/// `error_bound` bounds how much deeper than `deepest` any point of A's boundary can be (any
/// vertex, for PenetrationPoints::vertices). For shapes with a deviation it also bounds how much
/// less deep the deepest boundary point of the shapes themselves can be; the depth of a point is
/// then off by at most the deviation of B, at a point that is off by at most that of A.
struct PenetrationResult : ResultSummary, PenetrationValues {
    using Values = PenetrationValues;  ///< what it states besides summary and points
    using Point = PenetratingPoint;    ///< what it lists
    /// In order along A's rings. If a run of points spans the first vertex of a ring, some
    /// techniques list the whole run at the start of the ring.
    std::vector<PenetratingPoint> points;
};

/// One grid sample that lies in both shapes.
struct IntersectionSample {
    /// The value of `edge` if the query uses A's volume.
    static constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
    Vector2 position;              ///< the centre of a cell
    std::uint32_t edge = no_edge;  ///< an edge of A nearby, if the query uses A's boundary
};

/// What an IntersectionResult states besides its summary and samples.
struct IntersectionValues {
    IntersectionKind kind = IntersectionKind::volume_volume;        ///< of the query
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< of the query
    std::uint64_t count = 0;                                        ///< number of samples found
    double area = 0.0;  ///< count times the area of a cell
    Rectangle box;      ///< bounding box of all samples' points; meaningful if count > 0
};

/// Answer to an IntersectionQuery.
///
/// `error_bound`, called e here: every sample is within e of both shapes, and every point deeper
/// than e in both shapes has a sample within e. If the query uses a shape's boundary, points on
/// that boundary take the place of points deep in that shape.
struct IntersectionResult : ResultSummary, IntersectionValues {
    using Values = IntersectionValues;        ///< what it states besides summary and samples
    using Point = IntersectionSample;         ///< what it lists
    std::vector<IntersectionSample> samples;  ///< by region, then row by row from the low corner
};

/// The field at one of DistanceFieldQuery::points.
struct FieldPoint {
    Vector2 position;  ///< of the query
    /// Signed distance: bilinear between the four cell centres around the point.
    double distance = 0.0;
    /// Maximum error of `distance`; at most DistanceFieldResult::error_bound + d. A distance field
    /// is 1-Lipschitz, so each of the four cells limits the exact value; this is the remaining
    /// interval.
    double error_bound = 0.0;
    /// The sign, 0 outside and 1 inside, bilinear between the same four cells; the point counts as
    /// inside above 0.5. Correct if the boundary is farther than 1.0824 d + the result's
    /// error_bound.
    double inside = 0.0;
    /// By DistanceFieldQuery::gradient. Analytic: at the point itself, from `feature`. The other
    /// methods: bilinear between the gradients of the four cells.
    Vector2 gradient;
    Feature feature;     ///< of B's boundary, nearest to the point itself
    bool unique = true;  ///< as PenetratingPoint::unique, for `feature` and the analytic gradient
};

/// The grid of a distance field: its cells, row by row from the lowest.
struct FieldGrid {
    Vector2 origin;            ///< low corner of cell (0, 0), world coordinates
    double cell = 0.0;         ///< side of a cell, world units
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
};

/// Answer to a DistanceFieldQuery. `error_bound` bounds the difference from the exact signed
/// distance at every cell centre that was read back.
///
/// Outputs per cell have width * height entries, row by row from the lowest, and are empty if not
/// requested. Features are those of B's own edges. The nearest is decided in single precision in
/// grid cells: if two are equally near to within d/1000, or to within 2^-18 of the distance if that
/// is more, either may be named, and `unique` is 0.
struct DistanceFieldResult : ResultSummary {
    Vector2 origin;                    ///< low corner of cell (0, 0)
    std::uint32_t width = 0;           ///< cells along x
    std::uint32_t height = 0;          ///< cells along y
    std::vector<float> values;         ///< signed distance per cell, negative inside B
    std::vector<Feature> features;     ///< of B's boundary, nearest to the cell centre
    std::vector<float> gradients;      ///< two entries per cell: x and y
    std::vector<std::uint8_t> unique;  ///< 1 or 0 per cell; with features or analytic gradients
    std::vector<FieldPoint> points;    ///< in the order of the query
    /// Error bound of either component of a gradient at a cell; 0 if none was requested. Analytic:
    /// the difference from the unit vector between the centre and the nearest point of the feature
    /// named (on the boundary, its outward normal). The other methods: the difference from central
    /// differences of the exact signed distance.
    double gradient_error_bound = 0.0;
    /// The Vulkan format in which a blended gradient was computed ("R32G32_SFLOAT"); empty for
    /// other gradients. A string literal.
    const char* gradient_format = "";
};

/// One of the two shapes of a query.
enum class Side : std::uint8_t {
    a,  ///< the query's `a`
    b,  ///< the query's `b`
};

/// A point of one boundary that is close to the other boundary.
struct ContactPoint {
    Vector2 position;  ///< on the boundary of the shape `on`
    /// Unit normal of B's boundary, pointing out of B. For a point of A: the direction in which B's
    /// signed distance grows. For a point on B's boundary, or within 2^-15 cells of it: the normal
    /// of the edge, or the mean of two edges' normals at a vertex.
    Vector2 normal;
    double distance = 0.0;  ///< from `position` to `nearest`, >= 0
    Vector2 nearest;        ///< the nearest point of the other shape's boundary
    Feature feature;        ///< of the other shape: where `nearest` lies
    Side on = Side::a;      ///< the shape whose boundary `position` is on
    bool inside = false;    ///< `position` lies inside the other shape, deeper than d/1024
    /// As PenetratingPoint::unique. Also false if ContactNormals::gradient found almost no
    /// gradient and the analytic normal was used instead.
    bool unique = true;
};

/// A few points that represent a cluster of contacts: a connected part of the contact between A and
/// B whose normals are within 45 degrees of their mean.
struct ContactCluster {
    /// The first end of the cluster, in the order of A's vertices: a point of A's boundary. The
    /// ends are the contacts that reach farthest at right angles to `normal`; a contact outside B
    /// counts as nearer by twice its distance, one inside as farther by an eighth of its depth.
    /// Both ends are the same point if there is only one contact, and the deepest contact if the
    /// cluster runs straight into B.
    Vector2 first;
    Vector2 last;    ///< the other end
    Vector2 normal;  ///< mean of the contacts' normals, unit, points out of B
    /// The deepest contact if some are inside the other shape, otherwise the closest; among A's
    /// contacts and those of B's whose nearest point lies in this cluster.
    ContactPoint extreme;
    /// Number of contacts of A's boundary, or of B's if A has none in this cluster, for example
    /// where a tip of B comes close to a long edge of A between two samples.
    std::uint32_t count = 0;
};

/// What a ContactResult states besides its summary, manifold and points.
struct ContactValues {
    std::uint32_t count = 0;  ///< number of contacts, on both boundaries
};

/// Answer to a ContactQuery.
///
/// The numbers of a point are computed in double precision from the vertices as given, except the
/// normal with ContactNormals::gradient. No point is farther from the other boundary than the
/// contact distance. Every point of either boundary that is no farther from the other than the
/// contact distance minus `error_bound` has one listed within `error_bound` of it.
struct ContactResult : ResultSummary, ContactValues {
    using Values = ContactValues;          ///< what it states besides summary, manifold and points
    using Point = ContactPoint;            ///< what it lists
    std::vector<ContactCluster> manifold;  ///< in order along A's rings, then those of B alone
    /// A's, then B's, each in order along the rings as PenetrationResult::points are.
    std::vector<ContactPoint> points;
};

/// What a ClosestPointResult states besides its summary.
struct ClosestPointValues {
    Vector2 point;          ///< of A: closest to B
    Vector2 nearest;        ///< of B: closest to `point`
    double distance = 0.0;  ///< from `point` to `nearest`; 0 if the shapes intersect
    Vector2 direction;      ///< unit vector from `point` to `nearest`; (0, 0) at distance 0
    Feature feature_a;      ///< where `point` lies on A's boundary; meaningful if distance > 0
    Feature feature_b;      ///< where `nearest` lies on B's boundary; meaningful if distance > 0
    /// False if the closest point is one of several: another pair, one of them a vertex, is as
    /// close up to d/1000, and its point of A is farther from `point` than d.
    bool unique = true;
    /// The minimum distance at the points of A that were rendered, at most a cell more than
    /// `distance`. 0 if the shapes intersect; equal to `distance` if nothing was rendered.
    double sampled_distance = 0.0;
};

/// Answer to a ClosestPointQuery. `error_bound` bounds the error of `distance`: the rounding of
/// double precision, plus the shapes' deviations. Shapes that intersect have distance 0, no
/// direction, and a common point.
struct ClosestPointResult : ResultSummary, ClosestPointValues {
    using Values = ClosestPointValues;  ///< what it states besides its summary
    using Point = NoPoint;              ///< what it lists, nothing
};

/// What a SeparationResult states besides its summary.
struct SeparationValues {
    double distance = 0.0;  ///< from point_a to point_b, world units; 0 if they intersect
    Vector2 point_a;        ///< of A
    Vector2 point_b;        ///< of B
    Vector2 direction;      ///< unit vector from point_a to point_b; (0, 0) at distance 0
    Feature feature_a;      ///< where point_a lies on A's boundary; meaningful if distance > 0
    Feature feature_b;      ///< where point_b lies on B's boundary; meaningful if distance > 0
    bool unique = true;     ///< false if the pair is one of several
    /// As ClosestPointResult::sampled_distance, for points of both shapes.
    double sampled_distance = 0.0;
};

/// Answer to a SeparationQuery; `error_bound` and intersecting shapes as for ClosestPointResult.
/// Swapping A and B gives the same distance. `unique` refers to both points: false if another pair,
/// one of them a vertex, is as close up to d/1000 and one of its points is farther than d from this
/// pair's.
struct SeparationResult : ResultSummary, SeparationValues {
    using Values = SeparationValues;  ///< what it states besides its summary
    using Point = NoPoint;            ///< what it lists, nothing
};

/// What an IntersectionTestResult states besides its summary: nothing.
struct IntersectionTestValues {};

/// Answer to an IntersectionTestQuery: `intersects`. `error_bound` is the rounding of transformed
/// vertices plus the shapes' deviations. If a motion of at most `error_bound` would join or
/// separate the shapes, either answer may be reported; otherwise the answer is exact. `tolerance`
/// and `cell` are 0.
struct IntersectionTestResult : ResultSummary, IntersectionTestValues {
    using Values = IntersectionTestValues;  ///< what it states besides its summary
    using Point = NoPoint;                  ///< what it lists, nothing
};

/// The outcome of a TimeOfImpactQuery.
enum class ImpactState : std::uint8_t {
    separated,              ///< the shapes do not touch from time 0 to time 1
    hit,                    ///< they are separated at time 0 and touch later
    intersecting_at_start,  ///< they touch at time 0
    /// They do not touch before `time`; max_steps did not suffice to decide what follows.
    bound_not_reached,
};

/// The name of a state as in the enumeration, e.g. "bound_not_reached".
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(ImpactState state) noexcept;

/// What a TimeOfImpactResult states besides its summary.
struct TimeOfImpactValues {
    ImpactState state = ImpactState::separated;  ///< the outcome
    /// They do not touch before this time: 0 if they touch at the start, 1 if they never touch.
    double time = 0.0;
    /// Hit: they touch no later than `time` plus this, which respects the tolerance and the time
    /// bound of the query. Bound not reached: the rest of the motion, in which a contact may be
    /// missed; they touch at its end if `intersects` is true. 0 otherwise.
    double time_error_bound = 0.0;
    Pose pose_a;            ///< A's pose at `time`
    Pose pose_b;            ///< B's pose at `time`
    double distance = 0.0;  ///< between the shapes at `time`
    /// A certified lower bound of the distance from 0 to `time`. At least an eighth of the minimum
    /// distance; with a contact distance c, at least c plus an eighth of the amount by which the
    /// minimum distance exceeds c.
    double min_distance = 0.0;
    Vector2 point_a;          ///< of A at `time`, closest to B; a common point at distance 0
    Vector2 point_b;          ///< of B at `time`, closest to A; a common point at distance 0
    Vector2 direction;        ///< unit vector from point_a to point_b; (0, 0) at distance 0
    Feature feature_a;        ///< where point_a lies on A's boundary; meaningful if distance > 0
    Feature feature_b;        ///< where point_b lies on B's boundary; meaningful if distance > 0
    std::uint32_t steps = 0;  ///< number of evaluations of the shapes
};

/// Answer to a TimeOfImpactQuery. Shapes touch if they share a point or, with a contact distance,
/// are no farther apart than that. `time` is never late: in every state, the shapes do not touch
/// before it. Holds for the rings as given, as `intersects` does.
///
/// `error_bound`: shapes that are separated by at most this much, or by at most this much more than
/// the contact distance, may be reported as touching (the rounding of transformed vertices plus the
/// shapes' deviations). `intersects`: the shapes were found to touch at time + time_error_bound or
/// before. It is false for a hit at which they only came so close that rounding cannot tell.
struct TimeOfImpactResult : ResultSummary, TimeOfImpactValues {
    using Values = TimeOfImpactValues;  ///< what it states besides its summary
    using Point = NoPoint;              ///< what it lists, nothing
};

/// What a SeparationVectorResult states besides its summary.
struct SeparationVectorValues {
    Vector2 vector;       ///< add it to the translation of A's pose
    double length = 0.0;  ///< of the vector
    /// No translation of A shorter than this separates the shapes by more than `error_bound`.
    double lower_bound = 0.0;
    std::uint64_t work = 0;  ///< work done, in the unit of SeparationVectorQuery::max_work
};

/// Answer to a SeparationVectorQuery. The vector is verified by the intersection test: A moved by
/// it shares no point with B. If `intersects` is false, vector and lengths are zero.
///
/// `error_bound`: the rounding of transformed vertices plus the shapes' deviations. The rings as
/// given are separated; shapes with a deviation may still be as deep in each other as the sum of
/// their deviations.
struct SeparationVectorResult : ResultSummary, SeparationVectorValues {
    using Values = SeparationVectorValues;  ///< what it states besides its summary
    using Point = NoPoint;                  ///< what it lists, nothing
};

/// What a ContainmentResult states besides its summary.
struct ContainmentValues {
    bool inside = false;  ///< every point of A is a point of B
    /// The least distance between the boundaries if A is inside. 0 if they touch, or are so close
    /// that rounding cannot tell; 0 if A is not inside.
    double clearance = 0.0;
    /// Of A's boundary, closest to B's; at clearance 0 a common point of the boundaries. Both
    /// points are (0, 0) if A is not inside.
    Vector2 point_a;
    Vector2 point_b;    ///< of B's boundary, closest to A's
    Vector2 direction;  ///< unit vector from point_a to point_b; (0, 0) at clearance 0
    Feature feature_a;  ///< where point_a lies on A's boundary; meaningful if clearance > 0
    Feature feature_b;  ///< where point_b lies on B's boundary; meaningful if clearance > 0
    /// False if the pair is one of several: another one is as close up to the rounding of the
    /// vertices, and one of its points is farther than that from this pair's. True at clearance 0.
    bool unique = true;
};

/// Answer to a ContainmentQuery. Holds for the rings as given, as `intersects` does.
///
/// Touching from inside counts as inside: a shape is inside itself, with clearance 0. Every edge of
/// a ring counts as boundary, also one that two parts of B share: a shape across it is inside, with
/// clearance 0.
///
/// `error_bound` (the rounding of transformed vertices plus the shapes' deviations) bounds the
/// error of `clearance`. The shapes may be reported either way if moving each boundary by at most
/// this much could change the answer; but rings that lie inside without any move are never reported
/// as not inside. `tolerance` and `cell` are 0.
struct ContainmentResult : ResultSummary, ContainmentValues {
    using Values = ContainmentValues;  ///< what it states besides its summary
    using Point = NoPoint;             ///< what it lists, nothing
};

/// One result of any kind, in the order of AnyQuery.
using AnyResult =
    std::variant<PenetrationResult, IntersectionResult, DistanceFieldResult, ContactResult,
                 ClosestPointResult, SeparationResult, IntersectionTestResult, TimeOfImpactResult,
                 SeparationVectorResult, ContainmentResult>;

/// The results of one batch, in the order of its queries. The object keeps its memory when reused.
struct Results {
    std::vector<AnyResult> results;  ///< one per query, in order
    Timings timings;                 ///< of the batch as a whole
    std::uint64_t batch = 0;         ///< Batch::number() of the batch

    /// The result of a query. If the handle belongs to another batch, is out of range or names a
    /// query of another kind, returns a result whose status is invalid_query and says why. Borrowed
    /// from the results.
    template <class Query>
    [[nodiscard]] const typename Query::Result& operator[](
        QueryHandle<Query> handle) const noexcept {
        using Result = typename Query::Result;
        if (handle.batch != batch && handle.batch != 0) {
            static const Result other_batch = no_result<Result>(NoResult::other_batch);
            return other_batch;
        }
        if (handle.index >= results.size()) {
            static const Result out_of_range = no_result<Result>(NoResult::out_of_range);
            return out_of_range;
        }
        if (const auto* const result = std::get_if<Result>(&results[handle.index])) {
            return *result;
        }
        static const Result other_kind = no_result<Result>(NoResult::other_kind);
        return other_kind;
    }

private:
    enum class NoResult : std::uint8_t {
        other_batch,   ///< of the handle
        out_of_range,  ///< the position
        other_kind,    ///< of query
    };
    NEARFIELD_EXPORT static Status status_of(NoResult fault) noexcept;
    template <class Result>
    static Result no_result(NoResult fault) noexcept {
        Result result;
        result.status = status_of(fault);
        return result;
    }
};

}  // namespace nearfield
