#pragma once

#include <nearfield/export.hpp>
#include <nearfield/shape.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

/// \file
/// The queries. A Batch collects them; one batch is one unit of work.
///
/// An invalid value fails with StatusCode::invalid_query in the query's own result: a number out of
/// its stated range or not finite, a coordinate above `largest_coordinate`, an invalid enumerator,
/// a tolerance below what double precision resolves at the query's coordinates.

namespace nearfield {

// Defined in result.hpp.
struct PenetrationResult;
struct IntersectionResult;
struct DistanceFieldResult;
struct ContactResult;
struct ClosestPointResult;
struct SeparationResult;
struct IntersectionTestResult;
struct TimeOfImpactResult;
struct SeparationVectorResult;
struct ContainmentResult;

// Defined in on_device.hpp.
struct FieldTarget;
struct BufferTarget;

/// Upper limit of the deviations of a query's two shapes (Context::add_shape) added together, as a
/// fraction of its tolerance; above it the query fails (invalid_query).
inline constexpr double max_deviation = 0.25;

/// The technique that answers a query. ResultSummary::technique states which one did.
///
/// All techniques list the same points, with depths and distances that differ by less than d/1000.
/// A point penetrates a shape if it is inside and deeper than d/1024; otherwise it touches.
/// Intersections use the same cells. raster and cpu find the same samples and edges, bit for bit,
/// if the device has 8 sub-pixel bits, which cpu always assumes. The samples of compute may differ
/// near the boundaries, within the error bound. Fields have the same grid, and values within both
/// error bounds; signs differ only where these allow it, near the boundary.
enum class Technique {
    /// Selects cpu for every query that cpu answers. Exception: on a hardware device, if a batch
    /// has many pairs or field cells (Settings::device_thresholds), it selects compute for all
    /// queries of that group. Contacts with gradient normals, and queries that compute might refuse
    /// (too_large), stay with cpu. For what cpu does not answer it selects compute where that
    /// answers, otherwise raster.
    automatic,
    /// The paper's: fields are drawn on the device, and the results refined on the CPU.
    raster,
    /// Runs on the device without rasterisation: bit masks for volumes and boundaries, from the
    /// shapes' own edges for intersections, and lists of near edges for distances. It answers every
    /// query that raster answers, except GradientMethod::blended, which is drawn (invalid_query).
    /// Intersections of millions of edges, and fields with more than 12,000 edges about equally
    /// near to a cell, fail with too_large. IntersectionStrategy and SignEncoding, which are ways
    /// of drawing, are ignored. The CPU answers closest points and separations, as technique cpu
    /// does, and points of boundaries too large for the device.
    compute,
    /// Runs entirely on the CPU, and its answers have the same bits on every machine. Points are
    /// resolved to single edges in double precision, intersections by bit masks of a raster's
    /// samples, distance fields by the near edges of each block of cells. It answers every query
    /// except GradientMethod::blended and results on the device (invalid_query); it alone answers
    /// intersection tests, times of impact, separation vectors and containment.
    ///
    /// ResultSummary::regions are not sampled grids for points. They are the common box of both
    /// shapes (none for the summary of a penetration); for contacts the box around the parts of
    /// either shape that lie in the other's box grown by the contact distance. Closest points have
    /// none.
    cpu,
};

/// The name of a technique as in the enumeration, e.g. "raster".
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(Technique technique) noexcept;

/// The points of A that a penetration query examines.
enum class PenetrationPoints {
    boundary,  ///< samples along A's boundary, consecutive ones at most one cell (d * sqrt 2) apart
    vertices,  ///< A's own vertices
};

/// Point depth: for points of A's boundary inside B, the distance and direction to the nearest
/// point of B's boundary (section 2.2.4 of the paper, "Penetration Depth and Direction").
///
///     const auto deep = context.answer(nearfield::PenetrationQuery{
///         .a = {arrow, pose}, .b = {channel}, .tolerance = 0.1});
///     if (deep) {
///         for (const auto& point : deep->points) {
///             push(point.position, point.direction, point.depth);
///         }
///     }
struct NEARFIELD_EXPORT PenetrationQuery {
    using Result = PenetrationResult;  ///< the type of its result (result.hpp)

    Instance a = {};         ///< the shape whose points are examined
    Instance b = {};         ///< the shape that they penetrate
    double tolerance = 0.0;  ///< d, world units, > 0: half the diagonal of a grid cell
    PenetrationPoints points = PenetrationPoints::boundary;  ///< which points of A
    /// True: the answer is the summary (count, deepest), without points.
    bool summary_only = false;
    Technique technique = Technique::automatic;  ///< the technique that answers
    /// True: summary and points also stay on the device, for shaders to read (on_device.hpp).
    /// Technique::automatic then selects Technique::compute; the others fail (invalid_query), as do
    /// boundaries that are too large for the device (too_large).
    bool on_device = false;
    /// The host's buffer that results on the device go to; null: nearfield's own. Ignored if
    /// `on_device` is false. A target that cannot be written, or is too small for a summary, fails
    /// (invalid_query), and so does one that is too small for a field or for the samples of an
    /// intersection. Borrowed until run(), submit() or record() returns; the buffer itself, until
    /// the batch is collected.
    const BufferTarget* target = nullptr;
};

/// The part of each shape that an intersection uses (section 2.2.1 of the paper).
enum class IntersectionKind {
    boundary_boundary,  ///< the boundary of A and the boundary of B
    boundary_volume,    ///< the boundary of A and the interior of B
    volume_volume,      ///< the interior of A and the interior of B
};

/// The buffer in which Technique::raster finds the samples that both shapes cover: the rows of
/// Table 1 of the paper. Each strategy clears its region by drawing a rectangle, then draws B, then
/// A; each shape covers a sample at most once. All strategies give the same samples and the same
/// edges, bit for bit; they differ in device requirements and time.
///
/// A query fails in its own result (StatusCode::unsupported_strategy) if the device does not
/// support its strategy; the reasons list each missing feature or format. The other techniques
/// ignore the strategy.
enum class IntersectionStrategy {
    /// Stencil: cleared to 0; B increments; A increments where it is 1; samples with 2 are the
    /// result. Needs only the base.
    stencil,
    /// Colour: cleared to 0; B sets 128; A adds 127 by blending; samples with 255 are the result.
    /// Needs VK_FORMAT_R8G8B8A8_UNORM as a colour attachment that can be blended and sampled, which
    /// the specification guarantees on every device.
    blend,
    /// Colour: cleared to 0; B sets 127; A combines 128 by the logic operation OR; samples with 255
    /// are the result. Needs the feature logicOp, enabled on the device (HostDevice::logic_op).
    logic_op,
    /// Colour and depth: cleared to 0 and 1; B sets depth 0; A sets colour 255 where the depth
    /// equals 0; samples with colour 255 are the result. Needs only the base.
    depth,
};
/// The number of strategies.
inline constexpr std::size_t intersection_strategies = 4;

/// The name of a strategy as in the enumeration, e.g. "logic_op".
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(IntersectionStrategy strategy) noexcept;

/// The samples of a grid that lie in both shapes (section 2.2.1 and Table 1 of the paper).
///
///     const auto common = context.answer(nearfield::IntersectionQuery{
///         .a = {arrow, pose}, .b = {channel}, .tolerance = 0.01, .summary_only = true});
///     const double area = common ? common->area : 0.0;
struct NEARFIELD_EXPORT IntersectionQuery {
    using Result = IntersectionResult;  ///< the type of its result (result.hpp)

    Instance a = {};                                          ///< its boundary or volume, by `kind`
    Instance b = {};                                          ///< its boundary or volume, by `kind`
    double tolerance = 0.0;                                   ///< d, world units, > 0
    IntersectionKind kind = IntersectionKind::volume_volume;  ///< the part of each shape
    /// True: the answer is the summary (count, area, box), without samples. Memory then does not
    /// grow with the grid, except for the bit masks of Technique::compute.
    bool summary_only = false;
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< of Technique::raster
    Technique technique = Technique::automatic;                     ///< the technique that answers
    /// True: summary and samples also stay on the device, for shaders to read (on_device.hpp),
    /// whatever `summary_only` is; for techniques see PenetrationQuery::on_device.
    bool on_device = false;
    /// False: only the summary stays on the device, so its memory does not grow with the grid.
    /// Ignored if `on_device` is false.
    bool samples_on_device = true;
    const BufferTarget* target = nullptr;  ///< as PenetrationQuery::target
};

/// The buffer in which Technique::raster stores which cells are inside (section 2.2.2 of the paper
/// lists all three). All give the same sign everywhere. The other techniques ignore the encoding.
enum class SignEncoding {
    stencil,      ///< the stencil buffer, set to 1
    color,        ///< a separate colour buffer, set to white
    feature_bit,  ///< the top bit of the feature id in the image of nearest features
};

/// The method for the gradient of the signed distance (section 2.2.3 of the paper). Gradients point
/// towards increasing signed distance: away from B outside it, and out of B inside it.
enum class GradientMethod {
    /// From the nearest feature: the unit vector between the position and the nearest point of B's
    /// boundary. Exact up to rounding; if several points are nearest, it belongs to one of them.
    analytic,
    /// Half the difference of the signed distances at the two neighbouring cells, along x and along
    /// y.
    central_differences,
    /// Central differences of the whole image, by blended passes on the device, at the precision of
    /// a pixel. Technique::raster only; the other techniques fail (invalid_query).
    blended,
};

/// The signed distance field of B (section 2.2.2 of the paper): the distance to B's boundary at the
/// cell centres of a grid, negative inside B. Optionally also the nearest features (the Voronoi
/// diagram) and the gradient (section 2.2.3). Fails (invalid_query) if it requests no output.
///
///     const nearfield::Rectangle view{{-8.0, -8.0}, {16.0, 8.0}};
///     const auto field = context.answer(nearfield::DistanceFieldQuery{
///         .b = {channel}, .tolerance = 0.1, .rectangle = view});
///     const float first = field ? field->values[0] : 0.0F;  // outside: positive
struct DistanceFieldQuery {
    using Result = DistanceFieldResult;  ///< the type of its result (result.hpp)

    /// Defines the grid together with B; may be left out (the default) if `rectangle` is set.
    Instance a = {};
    Instance b = {};         ///< the shape whose distance is computed
    double tolerance = 0.0;  ///< d, world units, > 0; the side of a cell is d * sqrt 2
    /// The area of the grid, world coordinates; its low corner is that of cell (0, 0). Unset: the
    /// bounding boxes of A and B are intersected, and the intersection is grown by d on every side.
    /// The query fails if the boxes do not intersect.
    std::optional<Rectangle> rectangle = std::nullopt;
    SignEncoding sign = SignEncoding::stencil;  ///< of Technique::raster
    /// For gradients at cells and at points.
    GradientMethod gradient = GradientMethod::analytic;
    bool values = true;      ///< output the signed distance at every cell
    bool features = false;   ///< output the nearest feature at every cell
    bool gradients = false;  ///< output the gradient at every cell
    /// Points at which distance, sign and gradient are reconstructed from the four cells around
    /// each, world coordinates. Only those cells are read back for them. Each point must lie in the
    /// grid or on its edge; reconstruction uses a border of cells around the grid. Borrowed until
    /// run(), submit() or record() returns.
    std::span<const Vector2> points = {};
    Technique technique = Technique::automatic;  ///< the technique that answers
    /// True: images of the signed distance and of the nearest features stay on the device, for
    /// shaders to sample (on_device.hpp); for techniques see PenetrationQuery::on_device. `values`
    /// and `features` only select what is also returned to the CPU; both may be false.
    bool on_device = false;
    /// False: only the image of the signed distance stays, in a fraction of the time. Ignored if
    /// `on_device` is false.
    bool features_on_device = true;
    /// The host's images that the field on the device goes to; null: nearfield's own. Otherwise as
    /// PenetrationQuery::target.
    const FieldTarget* target = nullptr;
};

/// The source of contact normals.
enum class ContactNormals {
    analytic,  ///< the nearest feature: exact
    /// The paper's: bilinear interpolation of central differences of B's signed field. By every
    /// technique, the CPU computes this field around the contacts found.
    gradient,
};

/// Contact points and normals: the points of either boundary that are close to the other boundary,
/// inside and outside it (section 2.2.4 of the paper, "Contact Points and Normals").
///
///     const auto contacts = context.answer(nearfield::ContactQuery{
///         .a = {arrow, pose}, .b = {channel}, .tolerance = 0.05, .contact_distance = 0.1});
///     if (contacts) {
///         for (const auto& cluster : contacts->manifold) {
///             solve(cluster.normal, cluster.extreme);
///         }
///     }
struct NEARFIELD_EXPORT ContactQuery {
    using Result = ContactResult;  ///< the type of its result (result.hpp)

    Instance a = {};                ///< first shape
    Instance b = {};                ///< second shape; normals are those of its boundary
    double tolerance = 0.0;         ///< d, world units, > 0; contacts are at most a cell apart
    double contact_distance = 0.0;  ///< maximum distance of a contact, world units, > 0
    ContactNormals normals = ContactNormals::analytic;  ///< how normals are computed
    bool summary_only = false;  ///< true: the answer is summary and manifold, without points
    Technique technique = Technique::automatic;  ///< the technique that answers
    /// As PenetrationQuery::on_device; requires ContactNormals::analytic (invalid_query otherwise).
    bool on_device = false;
    const BufferTarget* target = nullptr;  ///< as PenetrationQuery::target
};

/// The point of A that is closest to B (section 2.2.4 of the paper, "Closest Point").
///
///     const auto closest = context.answer(nearfield::ClosestPointQuery{
///         .a = {arrow, far_pose}, .b = {channel}, .tolerance = 0.01});
///     const nearfield::Vector2 grip = closest ? closest->point : nearfield::Vector2{};
struct NEARFIELD_EXPORT ClosestPointQuery {
    using Result = ClosestPointResult;  ///< the type of its result (result.hpp)

    Instance a = {};  ///< the shape whose closest point is computed
    Instance b = {};  ///< the shape that it is closest to
    /// d, world units, > 0: half the diagonal of a cell of the grid on which the search is
    /// rendered. The grid is coarser if a boundary would have more than 4,096 samples
    /// (ResultSummary::cell states the cell used). The answer is exact in any case.
    double tolerance = 0.0;
    Technique technique = Technique::automatic;  ///< the technique that answers
};

/// The minimum distance between two shapes and where it occurs (section 2.2.4 of the paper,
/// "Separation Distance and Direction").
///
///     const auto gap = context.answer(
///         nearfield::SeparationQuery{.a = {arrow, far_pose}, .b = {channel}, .tolerance = 0.01});
///     const bool is_clear = gap && gap->distance > 0.5;
struct NEARFIELD_EXPORT SeparationQuery {
    using Result = SeparationResult;  ///< the type of its result (result.hpp)

    Instance a = {};                             ///< first shape
    Instance b = {};                             ///< second shape
    double tolerance = 0.0;                      ///< as for ClosestPointQuery
    Technique technique = Technique::automatic;  ///< the technique that answers
};

/// Tests whether the closed shapes A and B share a point; ResultSummary::intersects is the answer.
/// The answer holds up to the rounding of transformed vertices, so the query has no tolerance.
/// Always answered on the CPU: Technique::automatic or cpu; raster and compute fail
/// (invalid_query).
///
///     const auto test = context.answer(
///         nearfield::IntersectionTestQuery{.a = {arrow, pose}, .b = {channel}});
///     const bool overlaps = test && test->intersects;
struct NEARFIELD_EXPORT IntersectionTestQuery {
    using Result = IntersectionTestResult;  ///< the type of its result (result.hpp)

    Instance a = {};                             ///< first shape
    Instance b = {};                             ///< second shape
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// The time of impact of two moving shapes: when they first touch. From time 0 to time 1 each shape
/// moves from its instance's pose to its end pose, with constant linear and angular velocity: it
/// rotates about the origin of its own coordinates, by whole turns if the angles differ by that
/// much. A shape whose end pose equals its instance's pose does not move. Goes beyond the paper.
/// Always answered on the CPU, as IntersectionTestQuery.
///
///     const auto impact = context.answer(nearfield::TimeOfImpactQuery{
///         .a = {arrow, far_pose}, .b = {channel}, .end_a = pose, .tolerance = 0.001});
///     const double time = impact ? impact->time : 0.0;  // 1 if they never touch
struct NEARFIELD_EXPORT TimeOfImpactQuery {
    using Result = TimeOfImpactResult;  ///< the type of its result (result.hpp)

    Instance a = {};  ///< with A's pose at time 0
    Instance b = {};  ///< with B's pose at time 0
    Pose end_a = {};  ///< A's pose at time 1
    Pose end_b = {};  ///< B's pose at time 1
    /// d, world units, > 0: the time of impact is known to within an interval in which no two
    /// points of the shapes move by more than this relative to each other.
    double tolerance = 0.0;
    /// Upper limit of the length of that interval, in (0, 1].
    double time_bound = 1.0;
    /// Iteration limit (>= 1): how often the shapes are evaluated. About ten usually suffice;
    /// grazing or fast-spinning shapes need more. If the limit is reached, the state is
    /// ImpactState::bound_not_reached, after at most two further evaluations.
    std::uint32_t max_steps = 10000;
    /// The distance that counts as touching, world units, >= 0: the query finds the time at which
    /// the shapes first come this close. Useful for simulations that keep a gap, and for parts that
    /// need clearance.
    double contact_distance = 0.0;
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// The separation vector: a translation of A, as short as can be found, after which the shapes
/// share no point (a bound on the minimum translation vector, MTV). Goes beyond the paper, whose
/// penetration depth is that of single points. Always answered on the CPU, as
/// IntersectionTestQuery.
///
///     const auto way = context.answer(nearfield::SeparationVectorQuery{
///         .a = {arrow, pose}, .b = {channel}, .tolerance = 0.01});
///     const nearfield::Vector2 shift = way ? way->vector : nearfield::Vector2{};
struct NEARFIELD_EXPORT SeparationVectorQuery {
    using Result = SeparationVectorResult;  ///< the type of its result (result.hpp)

    Instance a = {};  ///< the shape that moves
    Instance b = {};  ///< the shape that stays
    /// d, world units, > 0: the search ends when the translation is known to be at most this much
    /// longer than the shortest one, or when `max_work` is used up.
    /// SeparationVectorResult::lower_bound states what is known then.
    double tolerance = 0.0;
    /// Work limit of the search. One unit is the test of an edge against an edge, a point or a
    /// line: a few nanoseconds. The limit does not cover the first translation, past the other
    /// shape's box, or the step in progress; each costs at most a few hundred units per edge of the
    /// shapes. A lower limit may give a longer vector and a smaller lower bound, both still valid.
    std::uint64_t max_work = 10'000'000;
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// Tests whether A lies inside B, and with how much clearance: A is inside if every point of the
/// closed shape A is a point of the closed shape B. A part of A outside B, or a hole of B in the
/// area of A, however small, means that it is not. The answer holds up to the rounding of
/// transformed vertices, so the query has no tolerance. Goes beyond the paper. Always answered on
/// the CPU, as IntersectionTestQuery.
///
///     const auto inside = context.answer(
///         nearfield::ContainmentQuery{.a = {arrow, pose}, .b = {sheet}});
///     const bool fits = inside && inside->inside && inside->clearance >= 0.5;
struct NEARFIELD_EXPORT ContainmentQuery {
    using Result = ContainmentResult;  ///< the type of its result (result.hpp)

    Instance a = {};                             ///< the shape that may be inside
    Instance b = {};                             ///< the shape that may contain it
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// Names a query of a batch. Its result is a Query::Result. A handle from Batch::add() is refused
/// (invalid_query) by results and tickets of any other batch, and of the same batch cleared and
/// filled again.
template <class Query>
struct QueryHandle {
    std::uint32_t index = UINT32_MAX;  ///< position in the batch; UINT32_MAX: no query
    std::uint64_t batch = 0;           ///< Batch::number(); 0: the position in any batch
};

/// One query of any kind.
using AnyQuery = std::variant<PenetrationQuery, IntersectionQuery, DistanceFieldQuery, ContactQuery,
                              ClosestPointQuery, SeparationQuery, IntersectionTestQuery,
                              TimeOfImpactQuery, SeparationVectorQuery, ContainmentQuery>;

/// An ordered list of queries. Clearing keeps the memory, so refilling a batch every frame does not
/// allocate. Not thread-safe; different batches are independent.
class Batch {
public:
    /// Appends a query of one of the kinds in AnyQuery. The handle finds its result in the results
    /// of the batch (Results::operator[]).
    template <class Query>
    QueryHandle<Query> add(const Query& query) {
        if (queries_.empty()) {
            number_ = next_number();
        }
        queries_.emplace_back(query);
        return {static_cast<std::uint32_t>(queries_.size() - 1), number_};
    }

    /// Removes all queries.
    void clear() noexcept { queries_.clear(); }
    /// True: the results state the time of each query (Timings::queries). False by default; clear()
    /// does not change it.
    void time_queries(bool on) noexcept { times_queries_ = on; }
    /// As set by time_queries().
    [[nodiscard]] bool times_queries() const noexcept { return times_queries_; }
    /// All queries in order. Borrowed until the batch changes.
    [[nodiscard]] std::span<const AnyQuery> queries() const noexcept { return queries_; }
    /// A number that distinguishes this filling of the batch from all others in the process; it
    /// changes after clear(). 0 if nothing was ever added. A copy has the same number.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

private:
    NEARFIELD_EXPORT static std::uint64_t next_number() noexcept;

    std::vector<AnyQuery> queries_;
    std::uint64_t number_ = 0;
    bool times_queries_ = false;
};

}  // namespace nearfield
