#pragma once

#include <nearfield/localization.hpp>
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
    Vector2 min;               ///< low corner, of cell (0, 0) too
    Vector2 max;               ///< high corner
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
};

/// What every result says.
struct ResultSummary {
    Status status;             ///< of this query alone; the rest is meaningful only where it is ok
    double tolerance = 0.0;    ///< d as asked
    double error_bound = 0.0;  ///< what the result's own description says it bounds; at most d
    /// The closed shapes share a point; containment and touching count. Said of the rings as given:
    /// shapes with a deviation can do the opposite where they are no farther apart, or no deeper in
    /// each other, than their deviations together. False for a distance field without a shape A.
    bool intersects = false;
    double cell = 0.0;  ///< side of a grid cell; samples of a boundary are no farther apart
    std::vector<Region> regions;          ///< what was sampled; Technique says where there is none
    LocalizationStatistics localization;  ///< what the search for regions did
    Technique technique = Technique::raster;  ///< what answered; never automatic
};

/// A part of a boundary: an edge without its end points, or a vertex. Indices count through all
/// rings of the shape in the order given.
struct Feature {
    /// Which of both it is.
    enum class Kind : std::uint8_t {
        edge,    ///< from vertex `index` to the next one of its ring
        vertex,  ///< vertex `index`
    };
    Kind kind = Kind::edge;   ///< edge or vertex
    std::uint32_t index = 0;  ///< among all edges, or all vertices, of the shape
};

/// One penetrating point of A.
struct PenetrationRecord {
    Vector2 point;       ///< on A's boundary, inside B
    double depth = 0.0;  ///< distance from `point` to `nearest`, > 0
    Vector2 direction;   ///< unit vector from `point` to `nearest`: the way out
    Vector2 nearest;     ///< the point of B's boundary nearest to `point`
    Feature feature;     ///< of B: where `nearest` lies
    /// False where the direction is one of several: the nearest point of another edge of B is no
    /// farther than `depth` + d/1000 and is not just a little way along the same wall, which is to
    /// say farther from `nearest` than twice what a straight wall would explain, 2 * sqrt((depth +
    /// d/1000)^2 - depth^2).
    bool unique = true;
};

/// Answer to a PenetrationQuery.
///
/// Each record's numbers are computed in double precision from the vertices as given. Which feature
/// is nearest is decided in single precision in grid cells: where two are equally near to within
/// d/1000, either may be named. `error_bound` bounds how much deeper than `deepest` any point of
/// A's boundary can be (any vertex, for PenetrationPoints::vertices). Where shapes have a deviation
/// it bounds too how much less deep any boundary point of the shapes themselves can have to be, and
/// a record's depth is off by at most the deviation of B at a point that is off by that of A.
struct PenetrationResult : ResultSummary {
    std::uint32_t count = 0;    ///< penetrating points found
    PenetrationRecord deepest;  ///< meaningful where count > 0
    /// In order along A's rings; a stretch that goes on past a ring's first vertex may stand as
    /// one, at the ring's beginning, which differs between techniques.
    std::vector<PenetrationRecord> records;
};

/// One grid sample that lies in both shapes.
struct IntersectionSample {
    /// In place of an edge where A takes part by its volume.
    static constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
    Vector2 point;                 ///< the centre of a cell
    std::uint32_t edge = no_edge;  ///< where A takes part by its boundary: an edge of A nearby
};

/// Answer to an IntersectionQuery.
///
/// `error_bound`: every sample is within it of both shapes, and every point that is deeper than it
/// in both (or, by its boundary, lies on it) has a sample within it.
struct IntersectionResult : ResultSummary {
    IntersectionKind kind = IntersectionKind::volume_volume;        ///< as asked
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< as asked
    std::uint64_t count = 0;                                        ///< samples found
    double area = 0.0;  ///< count times the area of a cell
    Rectangle box;  ///< the smallest that holds every sample's point; meaningful where count > 0
    std::vector<IntersectionSample> samples;  ///< by region, then row by row from the low corner
};

/// The field at one of DistanceFieldQuery::points.
struct FieldPoint {
    Vector2 point;  ///< as asked
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

/// Which of the two shapes of a query.
enum class Side : std::uint8_t {
    a,  ///< the query's `a`
    b,  ///< the query's `b`
};

/// A point of one boundary that is close to the other.
struct ContactRecord {
    Vector2 point;          ///< on the boundary of the shape `on`
    Vector2 normal;         ///< unit normal of B's boundary there, pointing out of B
    double distance = 0.0;  ///< from `point` to `nearest`, >= 0
    Vector2 nearest;        ///< the nearest point of the other shape's boundary
    Feature feature;        ///< of the other shape: where `nearest` lies
    Side on = Side::a;      ///< whose boundary `point` is on
    bool inside = false;    ///< `point` lies inside the other shape
    /// As PenetrationRecord::unique; with ContactNormals::gradient also false where the field has
    /// next to no gradient, and the analytic normal stands for it.
    bool unique = true;
};

/// A stretch of the contact between A and B, in one piece and turning by less than a right angle,
/// told by a few points.
struct ContactCluster {
    /// The first of its two ends, points of A's boundary in the order of A's vertices: the contacts
    /// farthest along the stretch, at right angles to `normal`, where a contact's distance outside
    /// B counts twice against it and its depth an eighth for it. The same point where there is but
    /// one, and the deepest where the stretch runs straight into B.
    Vector2 first;
    Vector2 last;    ///< the other end
    Vector2 normal;  ///< mean of the contacts' normals, unit, pointing out of B
    /// The deepest contact where some are inside the other shape, else the closest; of A's contacts
    /// and of those of B's whose nearest point lies on this stretch.
    ContactRecord extreme;
    /// Contacts of A's boundary; of B's where A has none on this stretch, as where a tip of B comes
    /// close to a long edge of A between two samples.
    std::uint32_t count = 0;
};

/// Answer to a ContactQuery.
///
/// Each record's numbers are computed in double precision from the vertices as given, but for the
/// normal where ContactNormals::gradient is asked for. No record is farther from the other boundary
/// than the contact distance; every point of either boundary no farther from the other than the
/// contact distance less `error_bound` has a record within `error_bound` of it.
struct ContactResult : ResultSummary {
    std::uint32_t count = 0;               ///< contacts found, on both boundaries
    std::vector<ContactCluster> manifold;  ///< in order along A's rings, then those of B alone
    /// A's, then B's, each in order along the rings as PenetrationResult::records are.
    std::vector<ContactRecord> records;
};

/// Answer to a ClosestPointQuery. `error_bound` bounds the error of `distance`: the rounding of
/// double precision. Shapes that intersect have distance 0, no direction, and a common point.
struct ClosestPointResult : ResultSummary {
    Vector2 point;          ///< of A: closest to B
    Vector2 nearest;        ///< of B: closest to `point`
    double distance = 0.0;  ///< from `point` to `nearest`; 0 where the shapes intersect
    Vector2 direction;      ///< unit vector from `point` to `nearest`; (0, 0) at distance 0
    Feature feature_a;      ///< where `point` lies on A's boundary; meaningful at a distance > 0
    Feature feature_b;      ///< where `nearest` lies on B's
    /// False where the closest point is one of several: another point of A, farther from `point`
    /// than d, is as close to B up to d/1000.
    bool unique = true;
    /// The least distance at the points of A that were rendered: larger than `distance` by a cell
    /// at the most. 0 where the shapes intersect; `distance` where nothing was rendered.
    double sampled_distance = 0.0;
};

/// Answer to a SeparationQuery; the rest as in ClosestPointResult. Swapping A and B gives the same
/// distance. `unique` is about both points: false where another pair, one of its points farther
/// than d from this pair's, is as close up to d/1000.
struct SeparationResult : ResultSummary {
    double distance = 0.0;  ///< from point_a to point_b, world units; 0 where they intersect
    Vector2 point_a;        ///< of A
    Vector2 point_b;        ///< of B
    Vector2 direction;      ///< unit vector from point_a to point_b; (0, 0) at distance 0
    Feature feature_a;      ///< where point_a lies on A's boundary; meaningful at a distance > 0
    Feature feature_b;      ///< where point_b lies on B's
    bool unique = true;     ///< false where the pair is one of several
    double sampled_distance = 0.0;  ///< of the points of both that were rendered
};

/// Answer to an IntersectionTestQuery: `intersects`. Shapes whose distance is at most
/// `error_bound`, the rounding of their placed vertices and their deviations, may be said to
/// intersect or not; exact but for that. Tolerance and cell are 0.
struct IntersectionTestResult : ResultSummary {};

/// What a TimeOfImpactQuery found.
enum class ImpactState : std::uint8_t {
    separated,              ///< the shapes stay apart from time 0 to time 1
    hit,                    ///< they are apart at first and touch later
    intersecting_at_start,  ///< they touch at time 0
    /// They are apart before `time`, and most_steps did not suffice to say what comes after it.
    bound_not_reached,
};

/// The name of a state as it stands in the enumeration ("bound_not_reached").
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(ImpactState state) noexcept;

/// Answer to a TimeOfImpactQuery. Shapes touch where they share a point or, with a contact
/// distance, are no farther apart than that. Never late: whatever the state, the shapes do not
/// touch before `time`. Said of the rings as given, as `intersects` is.
///
/// `error_bound`: shapes no farther apart than this, or than this more than the contact distance,
/// may be said to touch; the rounding of placed vertices and the shapes' deviations. `intersects`:
/// the shapes were seen to touch, at time + time_error_bound or before. Of a hit it is false where
/// they were only seen so close that rounding cannot tell.
struct TimeOfImpactResult : ResultSummary {
    ImpactState state = ImpactState::separated;  ///< what there is to say of the motion
    /// The shapes do not touch from 0 up to it: 0 where they do at the start, 1 where they never
    /// do.
    double time = 0.0;
    /// Hit: they touch no later than `time` and this, which keeps to the tolerance and the time
    /// bound asked for. Bound not reached: if they touch no later than `time` and this, it was not
    /// found where; they touch at its end where `intersects` is true, else it is the rest of the
    /// motion. 0 otherwise.
    double time_error_bound = 0.0;
    Pose pose_a;            ///< at `time`
    Pose pose_b;            ///< at `time`
    double distance = 0.0;  ///< between the shapes at `time`
    /// The shapes were certified to be no closer than this from 0 to `time`; at least an eighth of
    /// the least distance there was; with a contact distance, that and an eighth of what the least
    /// distance was more.
    double least_distance = 0.0;
    Vector2 point_a;          ///< of A at `time`, closest to B; a common point at distance 0
    Vector2 point_b;          ///< of B at `time`, closest to A
    Vector2 direction;        ///< unit vector from point_a to point_b; (0, 0) at distance 0
    Feature feature_a;        ///< where point_a lies on A's boundary; meaningful at a distance > 0
    Feature feature_b;        ///< where point_b lies on B's
    std::uint32_t steps = 0;  ///< how often the shapes were looked at
};

/// Answer to a SeparationVectorQuery. The vector is verified: by the intersection test, A moved by
/// it shares no point with B. Where `intersects` is false it is zero, and so are the lengths.
///
/// `error_bound`: the rounding of placed vertices and the shapes' deviations. The rings as given
/// are separated; shapes with a deviation may still be as deep in each other as these together.
struct SeparationVectorResult : ResultSummary {
    Vector2 vector;       ///< to be added to the translation of A's pose
    double length = 0.0;  ///< of the vector
    /// No translation of A shorter than this takes the shapes farther apart than `error_bound`.
    double lower_bound = 0.0;
    std::uint64_t work = 0;  ///< what was looked at, as SeparationVectorQuery::most_work counts it
};

/// Time one pass took on the device.
struct PassTime {
    std::string name;           ///< as the render graph and debuggers have it
    double milliseconds = 0.0;  ///< from its first command to the end of its last
};

/// Where the time of a batch went, in milliseconds. The device works beside the CPU, so the parts
/// may add up to more than the total.
struct Timings {
    double localize = 0.0;  ///< hierarchies on the CPU
    double plan = 0.0;      ///< choice of techniques, simplification, meshes, atlas, upload
    double record = 0.0;    ///< commands
    /// From submission until its fence was seen signalled, by is_ready() or at the end of the wait
    /// in collect(): with other frames in between it holds what the caller did meanwhile. 0 for
    /// what was recorded, since the host submits it; `passes` are measured all the same.
    double device = 0.0;
    double decode = 0.0;  ///< reading results and making them exact; what the CPU answers alone
    double total = 0.0;   ///< inside submit() and collect(), or run(): work and waiting
    std::vector<PassTime> passes;  ///< by timestamps; empty where the queue has none
};

/// One result of any kind, in the order of AnyQuery.
using AnyResult = std::variant<PenetrationResult, IntersectionResult, DistanceFieldResult,
                               ContactResult, ClosestPointResult, SeparationResult,
                               IntersectionTestResult, TimeOfImpactResult, SeparationVectorResult>;

/// The kind of result that a kind of query has: ResultOf<Query>::type.
template <class Query>
struct ResultOf;

/// \cond
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

template <>
struct ResultOf<ContactQuery> {
    using type = ContactResult;
};
template <>
struct ResultOf<ClosestPointQuery> {
    using type = ClosestPointResult;
};
template <>
struct ResultOf<SeparationQuery> {
    using type = SeparationResult;
};

template <>
struct ResultOf<IntersectionTestQuery> {
    using type = IntersectionTestResult;
};
template <>
struct ResultOf<TimeOfImpactQuery> {
    using type = TimeOfImpactResult;
};

template <>
struct ResultOf<SeparationVectorQuery> {
    using type = SeparationVectorResult;
};
/// \endcond

/// The results of one batch, in the order of its queries. Reusing one object for every frame keeps
/// its memory.
struct Results {
    std::vector<AnyResult> results;  ///< one a query, in order
    Timings timings;                 ///< of the batch as a whole

    /// The result of a query. Precondition: the handle comes from the batch that was run.
    template <class Query>
    [[nodiscard]] const typename ResultOf<Query>::type& operator[](
        QueryHandle<Query> handle) const {
        return std::get<typename ResultOf<Query>::type>(results[handle.index]);
    }
};

}  // namespace nearfield
