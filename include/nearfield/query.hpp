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
/// What can be asked. Queries are collected in a Batch; one batch is one unit of work.

namespace nearfield {

/// The part of a query's tolerance that the deviations of its shapes (Context::add_shape) may take
/// up, together; a query where they take more is refused.
inline constexpr double most_deviation = 0.25;

/// What answers a query (ResultSummary::technique says what did).
///
/// All give the same records: the same points, depths and distances that differ by less than
/// d/1000, the same sides but for points that touch the other boundary. Intersections have the same
/// samples and edges, bit for bit. Fields have the same grid, and values within both bounds; raster
/// and compute the same signs, bit for bit.
enum class Technique {
    /// Whichever makes the batch take the least time, by what techniques cost on this machine
    /// (Settings::costs).
    automatic,
    /// The paper's: fields drawn on the device, refined on the CPU.
    raster,
    /// The same on the device without rasterisation: bit masks for fills, lists of near edges for
    /// distances. Answers every query that raster answers, but for GradientMethod::blended, which
    /// is a way of drawing (refused, invalid_query). IntersectionStrategy and SignEncoding are ways
    /// of drawing too, which all give the same answers: whichever is asked for makes no difference
    /// here, and none needs anything of the device.
    compute,
    /// The device has no part in it. Points: down to single edges, in double precision. No grid is
    /// sampled in regions: they are the common box of both shapes, none for penetration without
    /// records; for contacts the box around what either shape has in the other's box grown by the
    /// contact distance; and what localisation found where normals are gradients, or boundaries
    /// have so many samples that Settings::memory_limit does not let all be kept at once. Closest
    /// points have none. Intersections: bit masks of the raster's samples. Distance fields: the
    /// near edges of each block of cells. Answers every query but GradientMethod::blended (refused,
    /// invalid_query), and intersection tests, times of impact and separation vectors it alone.
    cpu,
};

/// The name of a technique as it stands in the enumeration ("raster").
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(Technique technique) noexcept;

/// Which points of A a penetration query looks at.
enum class PenetrationPoints {
    boundary,  ///< samples along A's boundary, consecutive ones at most one cell (d * sqrt 2) apart
    vertices,  ///< A's own vertices
};

/// Point depth: for points of A's boundary inside B, the distance and direction to the nearest
/// point of B's boundary (the paper's section 2.2.4, "Penetration Depth and Direction").
struct PenetrationQuery {
    Instance a = {};         ///< whose points are looked at
    Instance b = {};         ///< in which they lie
    double tolerance = 0.0;  ///< d, world units, > 0: half the diagonal of a grid cell
    PenetrationPoints points = PenetrationPoints::boundary;  ///< which points of A
    bool records = true;  ///< false: keep the summary (count, deepest) and leave the records out
    Technique technique = Technique::automatic;  ///< what answers
    /// True: summary and records stay on the device as well, for shaders to read (resident.hpp);
    /// Technique::automatic then chooses among those that answer on the device, and
    /// Technique::cpu is refused (invalid_query).
    bool resident = false;
};

/// What of each shape takes part in an intersection (the paper's section 2.2.1).
enum class IntersectionKind {
    boundary_boundary,  ///< the boundary of A and the boundary of B
    boundary_volume,    ///< the boundary of A and the interior of B
    volume_volume,      ///< the interior of A and the interior of B
};

/// Which buffer of the raster finds the samples that both shapes cover: the rows of the paper's
/// Table 1. Each clears its region by a drawn rectangle, draws B, then A, each shape's coverage
/// counted once a sample. All give the same samples, bit for bit, and the same edges; they differ
/// in what Vulkan has to offer and in time.
///
/// A query whose strategy the device lacks is refused in its own result
/// (StatusCode::unsupported_strategy); the reasons name each missing feature or format. The other
/// techniques find the same samples by none of them, so they take any.
enum class IntersectionStrategy {
    /// Stencil: cleared to 0, B increments, A increments where it is 1; found where it is 2. Needs
    /// nothing but the base.
    stencil,
    /// Colour: cleared to 0, B sets 128, A adds 127 by blending; found where it is 255. Needs
    /// VK_FORMAT_R8G8B8A8_UNORM as a colour attachment that blends and can be sampled, which the
    /// specification promises on every device.
    blend,
    /// Colour: cleared to 0, B sets 127, A combines 128 by the logic operation OR; found where it
    /// is 255. Needs the feature logicOp, enabled on the device (HostDevice::logic_op).
    logic_op,
    /// Colour and depth: cleared to 0 and 1, B sets depth 0, A sets colour 255 where the depth
    /// equals 0; found where the colour is 255. Needs nothing but the base.
    depth,
};
/// How many strategies there are.
inline constexpr std::size_t intersection_strategies = 4;

/// The name of a strategy as it stands in the enumeration ("logic_op").
[[nodiscard]] NEARFIELD_EXPORT const char* to_string(IntersectionStrategy strategy) noexcept;

/// The samples of a grid that lie in both shapes (section 2.2.1, Table 1).
struct IntersectionQuery {
    Instance a = {};         ///< takes part by its boundary or volume, as `kind` says
    Instance b = {};         ///< likewise
    double tolerance = 0.0;  ///< d, world units, > 0
    IntersectionKind kind = IntersectionKind::volume_volume;  ///< what of each takes part
    /// False: keep the summary (count, area, box) and leave the samples out. None are listed then,
    /// so memory does not grow with the grid, but for the bit masks of Technique::compute.
    bool records = true;
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< of Technique::raster
    Technique technique = Technique::automatic;                     ///< what answers
    /// True: summary and samples stay on the device as well, whatever `records` says of those that
    /// come back, for shaders to read (resident.hpp); of techniques as PenetrationQuery::resident.
    bool resident = false;
    /// False: of what stays on the device the summary alone, whose memory does not grow with the
    /// grid. Nothing where `resident` is false.
    bool resident_samples = true;
};

/// Which buffer of the raster says which cells lie inside (section 2.2.2 lists all three). They
/// give the same sign everywhere. The other techniques have no need of any and take all.
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
    /// Only Technique::raster answers it; the others refuse it (invalid_query).
    blended,
};

/// The signed distance field of B (section 2.2.2): distance to B's boundary at the centres of a
/// grid of cells, negative inside B; and what follows from it, the image of nearest features (the
/// Voronoi diagram) and the gradient (section 2.2.3). Refused where nothing is asked for.
struct DistanceFieldQuery {
    Instance a =
        {};  ///< whose box is shared; may be left out (the default) where a rectangle is given
    Instance b = {};         ///< whose distance is asked for
    double tolerance = 0.0;  ///< d, world units, > 0; the side of a cell is d * sqrt 2
    /// What the grid covers; its low corner is the low corner of cell (0, 0). Left out: what the
    /// bounding boxes of A and B have in common, grown by d on every side; an error where they have
    /// nothing in common.
    std::optional<Rectangle> rectangle = std::nullopt;
    SignEncoding sign = SignEncoding::stencil;  ///< of Technique::raster
    /// Of the gradients asked for, at cells and at points.
    GradientMethod gradient = GradientMethod::analytic;
    bool values = true;      ///< the signed distance at every cell
    bool features = false;   ///< the nearest feature at every cell
    bool gradients = false;  ///< the gradient at every cell
    /// Places where distance, sign and gradient are reconstructed from the four cells around, world
    /// coordinates. Only those cells are read back for them. Each has to lie in the grid, edge
    /// included (reconstruction takes cells from a border around the grid). Borrowed until run() or
    /// submit() returns.
    std::span<const Vector2> points = {};
    Technique technique = Technique::automatic;  ///< what answers
    /// True: images of the signed distance and of the nearest features stay on the device, for
    /// shaders to sample (resident.hpp); of techniques as PenetrationQuery::resident. `values` and
    /// `features` say what comes back to the CPU beside; both may be false, and then nothing does.
    bool resident = false;
};

/// Where the normal of a contact comes from.
enum class ContactNormals {
    analytic,  ///< from the nearest feature: exact
    gradient,  ///< the paper's: bilinear of central differences of B's signed field at cells
};

/// Contact points and normals: the points of either boundary that are close to the other boundary
/// (the paper's section 2.2.4, "Contact Points and Normals"), inside and outside alike.
struct ContactQuery {
    Instance a = {};                ///< one of the two
    Instance b = {};                ///< the other, whose normals are given
    double tolerance = 0.0;         ///< d, world units, > 0: contacts lie at most a cell apart
    double contact_distance = 0.0;  ///< how close counts as contact, world units, > 0
    ContactNormals normals = ContactNormals::analytic;  ///< how normals are found
    bool records = true;  ///< false: keep the summary and the manifold, leave the records out
    Technique technique = Technique::automatic;  ///< what answers
    /// As PenetrationQuery::resident; with ContactNormals::analytic alone (invalid_query else).
    bool resident = false;
};

/// The point of A that is closest to B (section 2.2.4, "Closest Point").
struct ClosestPointQuery {
    Instance a = {};  ///< whose point is sought
    Instance b = {};  ///< what it is closest to
    /// d, world units, > 0: half the diagonal of a cell of the grid that the search is rendered
    /// with; coarser where that would take more than 4,096 samples of a boundary
    /// (ResultSummary::cell says what it was). The answer is exact whatever it is.
    double tolerance = 0.0;
    Technique technique = Technique::automatic;  ///< what answers
};

/// The least distance between two shapes, and where it is (section 2.2.4, "Separation Distance and
/// Direction").
struct SeparationQuery {
    Instance a = {};                             ///< one of the two
    Instance b = {};                             ///< the other
    double tolerance = 0.0;                      ///< as for ClosestPointQuery
    Technique technique = Technique::automatic;  ///< what answers
};

/// Whether the closed shapes A and B share a point: the answer is ResultSummary::intersects and
/// nothing else. Exact up to the rounding of placed vertices, so no tolerance is asked for. Always
/// answered on the CPU (Technique::automatic or cpu): raster and compute are refused
/// (invalid_query).
struct IntersectionTestQuery {
    Instance a = {};                             ///< one of the two
    Instance b = {};                             ///< the other
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// When two moving shapes first touch. From time 0 to time 1 each moves from its instance's pose to
/// its end: translation and angle change at a constant rate, so a shape turns about the origin of
/// its own coordinates (by whole turns too, where the angles say so), and a shape whose end is its
/// instance's pose stands still. Goes beyond the paper. Always answered on the CPU, as
/// IntersectionTestQuery.
struct TimeOfImpactQuery {
    Instance a = {};  ///< with A's pose at time 0
    Instance b = {};  ///< with B's pose at time 0
    Pose end_a = {};  ///< A's pose at time 1
    Pose end_b = {};  ///< B's pose at time 1
    /// d, world units, > 0: the first contact is known to within a stretch of time in which no two
    /// points of the shapes move by more than this against each other.
    double tolerance = 0.0;
    /// And the stretch of time is no longer than this, in (0, 1].
    double time_bound = 1.0;
    /// How often the shapes may be looked at, at least 1. Mostly about ten times suffice; shapes
    /// that graze each other, or turn many times close to each other, take more. Where as many are
    /// not enough, the result says so (ImpactState::bound_not_reached), for which they are looked
    /// at twice more at the most.
    std::uint32_t most_steps = 10000;
    /// How close counts as touching, world units, >= 0: the time is sought at which the shapes
    /// first come as close as this. For what has to keep a gap: a simulation that goes back to just
    /// before a contact, a part that needs clearance.
    double contact_distance = 0.0;
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// A translation of A after which the shapes share no point, as short as can be found. Goes beyond
/// the paper, whose penetration depth is that of single points. Always answered on the CPU, as
/// IntersectionTestQuery.
struct SeparationVectorQuery {
    Instance a = {};  ///< moves
    Instance b = {};  ///< stands still
    /// d, world units, > 0: the search ends where the translation is known to be no more than this
    /// longer than the shortest one, or when it has used up most_work;
    /// SeparationVectorResult::lower_bound says what is known then.
    double tolerance = 0.0;
    /// How much may be looked at: an edge held against an edge, a point or a line is one, a few
    /// nanoseconds. It bounds the whole search, but for the first way out, past the other shape's
    /// box, and the step at hand: both take no more than a few hundred for each edge of the shapes.
    /// With less of it the vector is longer and the lower bound smaller; both hold all the same.
    std::uint64_t most_work = 10'000'000;
    Technique technique = Technique::automatic;  ///< automatic or cpu
};

/// Names a query of a batch and, by its type, the kind of result it has.
template <class Query>
struct QueryHandle {
    std::uint32_t index = UINT32_MAX;  ///< position in the batch; UINT32_MAX: no query
};

/// One query of any kind.
using AnyQuery = std::variant<PenetrationQuery, IntersectionQuery, DistanceFieldQuery, ContactQuery,
                              ClosestPointQuery, SeparationQuery, IntersectionTestQuery,
                              TimeOfImpactQuery, SeparationVectorQuery>;

/// An ordered list of queries. Clearing keeps the memory, so a batch that is filled anew each
/// frame does not allocate. Not thread-safe; different batches are independent.
class Batch {
public:
    /// Appends a query, of one of AnyQuery's kinds. The handle finds its result in the results of
    /// the batch.
    template <class Query>
    QueryHandle<Query> add(const Query& query) {
        queries_.emplace_back(query);
        return {static_cast<std::uint32_t>(queries_.size() - 1)};
    }

    /// Takes all queries out.
    void clear() noexcept { queries_.clear(); }
    /// All queries in order. Borrowed until the batch changes.
    [[nodiscard]] std::span<const AnyQuery> queries() const noexcept { return queries_; }

private:
    std::vector<AnyQuery> queries_;
};

}  // namespace nearfield
