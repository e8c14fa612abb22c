#pragma once

#include <nearfield/context.hpp>
#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

/// \file
/// A world: instances of shapes that stay from frame to frame, and queries that name the world
/// instead of two shapes. Input and output are spans of flat structures, one entry per pose, point
/// or segment, in the caller's memory.
///
/// Queries of a world are answered on the CPU, except for tables that the device fills
/// (world_device.hpp), exact up to the rounding that each answer's error bound states. What a world
/// keeps between queries makes them faster and never changes an answer: after any sequence of
/// calls, each answer is the same, bit for bit, as in a new world to which the present instances
/// were added in the order of their adding.

namespace nearfield {

/// Names an instance of one world. The default value names none. A handle of another world, or of
/// an instance that was removed, is refused (unknown_instance).
struct InstanceHandle {
    std::uint32_t index = UINT32_MAX;  ///< assigned by the world; UINT32_MAX: no instance
    std::uint32_t generation = 0;      ///< distinguishes successive instances with the same index
    std::uint32_t world = 0;           ///< number of the world, unique in the process

    /// True if both name the same instance of one world.
    friend bool operator==(const InstanceHandle&, const InstanceHandle&) = default;
};

/// An instance as a world keeps it.
///
/// Two instances form a pair only if each one's category has a bit in common with the other's mask.
struct WorldInstance {
    ShapeHandle shape = {};           ///< of the world's context
    Pose pose = {};                   ///< from shape coordinates to world coordinates
    std::uint64_t user = 0;           ///< the caller's own value, returned by World::instance()
    std::uint32_t category = 1;       ///< what it is: a set of bits
    std::uint32_t mask = UINT32_MAX;  ///< the categories that it pairs with: a set of bits
};

/// The instances that a query considers: those whose category has a bit in common with `mask`, and
/// whose mask has one in common with `category`.
struct WorldFilter {
    std::uint32_t category = UINT32_MAX;  ///< what the query stands for: a set of bits
    std::uint32_t mask = UINT32_MAX;      ///< the categories considered: a set of bits
    /// An instance of this world to leave out, if it still exists: the one dragged.
    InstanceHandle ignored = {};
};

/// One shape at many poses: World::test_poses().
struct PoseTestQuery {
    ShapeHandle shape = {};   ///< of the world's context
    WorldFilter filter = {};  ///< the instances tested
};

/// One shape at many poses: World::find_clearances().
struct ClearanceQuery {
    ShapeHandle shape = {};   ///< of the world's context
    WorldFilter filter = {};  ///< the instances considered
    /// Clearances of at most this are not told apart, which saves time: the answer is this value,
    /// and no instance. World units.
    double min_clearance = -std::numeric_limits<double>::infinity();
    /// Instances farther away than this are not considered, which saves time: if there is no other,
    /// the answer is this value, and no instance. World units, >= 0 and above `min_clearance`.
    double max_clearance = std::numeric_limits<double>::infinity();
};

/// The least distance of a shape at one pose from the instances of a world. Of several that are
/// equally near, the instance added first counts.
struct Clearance {
    /// World units. Positive: the least distance of the shape from any instance. Otherwise it
    /// intersects instances: minus the depth of the deepest vertex, of the shape in any of them or
    /// of any of them in the shape; 0 if boundaries cross and no vertex is inside.
    double distance = std::numeric_limits<double>::infinity();
    /// Of `distance`, if there is an instance: rounding plus the shapes' deviations.
    double error_bound = 0.0;
    /// The nearest instance, or the one with the deepest vertex; none if `distance` is one of the
    /// limits of the query.
    InstanceHandle instance = {};
    Vector2 point = {};    ///< of the shape, where it is nearest or deepest; needs `direction`
    Vector2 nearest = {};  ///< of the instance; likewise
    /// Unit vector. Positive distance: from `point` to `nearest`. Negative: the direction in which
    /// the shape leaves the instance at the deepest vertex. (0, 0) at distance 0 and without an
    /// instance.
    Vector2 direction = {};
};

/// What World::find_nearest() searches for.
enum class NearestKind : std::uint8_t {
    instances,  ///< the nearest instances, each by its nearest boundary point
    edges,      ///< the nearest edges of all instances
};

/// The nearest instances, or edges, of many points: World::find_nearest().
struct NearestQuery {
    std::uint32_t count = 1;                    ///< the number wanted per point, >= 1
    NearestKind kind = NearestKind::instances;  ///< what is searched for
    /// Boundaries farther away than this are not considered. World units, >= 0.
    double max_distance = std::numeric_limits<double>::infinity();
    WorldFilter filter = {};  ///< the instances considered
};

/// One of the nearest instances, or edges, of a point.
struct NearestHit {
    InstanceHandle instance = {};  ///< none: fewer were found than wanted
    /// NearestKind::instances: signed distance of the point from the instance's boundary, negative
    /// inside. NearestKind::edges: distance from the edge, >= 0. World units.
    double distance = std::numeric_limits<double>::infinity();
    double error_bound = 0.0;  ///< of `distance`: rounding plus the shape's deviation
    Vector2 nearest = {};      ///< the nearest point of the boundary, or of the edge
    Feature feature = {};      ///< of the instance's shape: where `nearest` lies
};

/// The nearest instances of one shape at many poses: World::find_nearest().
struct ShapeNearestQuery {
    ShapeHandle shape = {};   ///< of the world's context
    WorldFilter filter = {};  ///< the instances considered
    std::uint32_t count = 1;  ///< the number wanted per pose, >= 1
    /// Instances farther away than this are not considered. World units, >= 0.
    double max_distance = std::numeric_limits<double>::infinity();
};

/// The nearest edges of one shape at many poses: World::find_nearest().
struct ShapeEdgeQuery {
    ShapeHandle shape = {};   ///< of the world's context
    WorldFilter filter = {};  ///< the instances considered
    std::uint32_t count = 1;  ///< the number wanted per pose, >= 1
    /// Edges farther away than this are not considered. World units, >= 0.
    double max_distance = std::numeric_limits<double>::infinity();
};

/// One of the edges nearest to a shape.
struct ShapeEdgeHit {
    InstanceHandle instance = {};  ///< none: fewer were found than wanted
    std::uint32_t edge = 0;        ///< of the instance's shape, among the edges of all its rings
    /// Least distance of the edge from the shape; 0 if they share a point, also where the edge lies
    /// inside. World units.
    double distance = std::numeric_limits<double>::infinity();
    double error_bound = 0.0;  ///< of `distance`: rounding plus the shapes' deviations
    Vector2 point = {};        ///< of the shape, nearest to the edge; at distance 0 of both
    Vector2 nearest = {};      ///< of the edge, nearest to `point`
    Vector2 direction = {};    ///< unit vector from `point` to `nearest`; (0, 0) at distance 0
};

/// A straight path from one point to another, in world coordinates.
struct Segment {
    Vector2 from = {};  ///< where it starts
    Vector2 to = {};    ///< where it ends
};

/// Where a segment crosses or touches the boundary of an instance.
struct RayHit {
    InstanceHandle instance = {};  ///< none: the segment hits nothing
    double parameter = 1.0;        ///< 0 at the start of the segment, 1 at its end
    double error_bound = 0.0;      ///< of `point`: rounding plus the shape's deviation
    Vector2 point = {};            ///< where it hits
    /// Unit normal of the edge, from its vertices in the world, which are rounded; against the
    /// segment's direction.
    Vector2 normal = {};
    std::uint32_t edge = 0;  ///< of the instance's shape, among the edges of all its rings
};

/// The hits of many segments: those of segment i are hits[offsets[i]] to hits[offsets[i + 1] - 1].
struct RayHits {
    std::vector<std::uint32_t> offsets;  ///< one more than there are segments; the first is 0
    std::vector<RayHit> hits;            ///< of each segment in order along it
};

/// Lists of instances: list i is instances[offsets[i]] to instances[offsets[i + 1] - 1].
struct InstanceLists {
    std::vector<std::uint32_t> offsets;     ///< one more than there are lists; the first is 0
    std::vector<InstanceHandle> instances;  ///< of each list in the order in which they were added
};

/// A motion from one pose to another in unit time, with constant velocity and angular velocity, as
/// TimeOfImpactQuery describes it.
struct Sweep {
    Pose start = {};  ///< at time 0
    Pose end = {};    ///< at time 1
};

/// A moving shape against a world that does not move: World::cast_shape().
struct ShapeCastQuery {
    ShapeHandle shape = {};         ///< of the world's context
    WorldFilter filter = {};        ///< the instances considered
    double tolerance = 0.0;         ///< as TimeOfImpactQuery::tolerance
    double contact_distance = 0.0;  ///< as TimeOfImpactQuery::contact_distance
};

/// When a moving shape first touches a world.
struct ShapeCastHit {
    ImpactState state = ImpactState::separated;  ///< the outcome
    /// The one touched first; none if separated. Of several, one touched at the start, then the one
    /// added first.
    InstanceHandle instance = {};
    double time = 1.0;              ///< as TimeOfImpactResult::time: never late
    double time_error_bound = 0.0;  ///< as TimeOfImpactResult::time_error_bound
    double error_bound = 0.0;       ///< as ResultSummary::error_bound of a TimeOfImpactResult
    Vector2 point = {};             ///< of the moving shape at `time`, nearest to `instance`
    Vector2 nearest = {};           ///< of `instance`, nearest to `point`
    Vector2 direction = {};  ///< unit vector from `point` to `nearest`; (0, 0) where they meet
};

template <class Query>
class PairTable;
class DevicePairTableBase;
struct DevicePoses;

/// Instances of shapes of one context, kept from frame to frame.
///
/// A shape may be deformed (Context::update_shape) between any two calls; all its instances follow.
/// Boxes over the edges of a shape and over all instances are made when a query first needs them
/// and refitted when something changes. A shape that is removed from the context takes its
/// instances out of all answers, for good.
///
/// Threads: as for the context, which is used by all members; the two count as one object. Many
/// poses, points, segments and pairs are divided among Settings::jobs. Results do not depend on
/// their number.
///
/// Lifetime: the context must outlive the world.
///
/// Errors: a call that fails changes nothing, and leaves its output undefined. Invalid numbers in a
/// query or pose are invalid_query, and the message names the first; handles of shapes are
/// unknown_shape, handles of instances unknown_instance.
///
/// Limits: every query can be given Limits (limits.hpp). If they end it, the call fails (cancelled
/// or budget_exhausted), so that no output looks whole that is not. The time that a world takes to
/// make and refit boxes counts; it is not divided by checkpoints.
class NEARFIELD_EXPORT World {
public:
    /// An empty world.
    [[nodiscard]] static Expected<World> create(Context& context);

    ~World();
    /// A moved-from world can only be destroyed or assigned to.
    World(World&&) noexcept;
    /// Destroys the world that was there before.
    World& operator=(World&&) noexcept;
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Adds an instance.
    [[nodiscard]] Expected<InstanceHandle> add(const WorldInstance& instance);
    /// Gives an instance another pose.
    Status move(InstanceHandle instance, const Pose& pose);
    /// Gives many instances other poses: instances[i] gets poses[i]. If an instance is named twice,
    /// the later pose counts. Fails (invalid_query) if the spans differ in length.
    Status move(std::span<const InstanceHandle> instances, std::span<const Pose> poses);
    /// Gives an instance another category and mask.
    Status set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask);
    /// Removes an instance. Its handle stays invalid from then on.
    Status remove(InstanceHandle instance);

    /// The instance as it is now.
    [[nodiscard]] Expected<WorldInstance> instance(InstanceHandle instance) const;
    /// The number of instances.
    [[nodiscard]] std::uint32_t size() const noexcept;

    /// For each pose, 1 if the shape there and an instance of the world share a point, otherwise 0.
    /// Exact up to the rounding of transformed vertices, as IntersectionTestQuery. Memory does not
    /// depend on the number of poses. Fails (invalid_query) if the spans differ in length.
    Status test_poses(const PoseTestQuery& query, std::span<const Pose> poses,
                      std::span<std::uint8_t> intersects, const Limits& limits = {});

    /// For each pose, the least distance of the shape there from the world. Neighbouring poses in
    /// sequence are faster than poses in random order. Otherwise as test_poses().
    Status find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                           std::span<Clearance> clearances, const Limits& limits = {});

    /// For each point, the nearest instances or edges in ascending order of NearestHit::distance:
    /// the instances that the point is inside come first, the deepest at the head. Of equally near
    /// ones, the instance added first, then the edge of lower index comes first. Point i gets
    /// hits[i * count] to hits[i * count + count - 1]. Fails (invalid_query) if there are not
    /// `count` times as many hits as points.
    Status find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                        std::span<NearestHit> hits, const Limits& limits = {});

    /// For each pose, the nearest instances of the shape there in ascending order of
    /// Clearance::distance, each with its own clearance, as if it were alone in the world: those
    /// that the shape intersects come first, the deepest at the head. Of equally near ones, the
    /// instance added first comes first. Pose i gets nearest[i * count] to
    /// nearest[i * count + count - 1]; where there are fewer, the rest name no instance and have an
    /// infinite distance. Fails (invalid_query) if there are not `count` times as many entries as
    /// poses.
    Status find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                        std::span<Clearance> nearest, const Limits& limits = {});

    /// For each pose, the nearest edges of all instances in ascending order of
    /// ShapeEdgeHit::distance. Of equally near ones, the instance added first, then the edge of
    /// lower index comes first. Otherwise as for instances.
    Status find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                        std::span<ShapeEdgeHit> hits, const Limits& limits = {});

    /// For each segment, the first hit. Of several at the same place, the one of the instance added
    /// first, at its edge of lowest index. Fails (invalid_query) if the spans differ in length.
    Status cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                     const WorldFilter& filter = {}, const Limits& limits = {});
    /// For each segment, all hits. A vertex where the segment passes from one edge to the next is
    /// one hit of each. An edge along the segment is hit where they first meet. Edges without
    /// length, between repeated vertices, are never hit.
    Status cast_rays(std::span<const Segment> segments, RayHits& hits,
                     const WorldFilter& filter = {}, const Limits& limits = {});

    /// For each motion of a shape, when it first touches the world. Fails (invalid_query) if the
    /// spans differ in length, or if the tolerance is too small for the coordinates of what a
    /// motion comes near; and as Context::run(), with ring_full if all batches are in flight.
    Status cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                      std::span<ShapeCastHit> hits, const Limits& limits = {});

    /// For each rectangle, the instances with which it shares a point, exact up to the rounding of
    /// transformed vertices.
    Status find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                         const WorldFilter& filter = {}, const Limits& limits = {});
    /// For each point, the instances that it lies in, or up to rounding on the boundary of.
    Status find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                         const WorldFilter& filter = {}, const Limits& limits = {});
    /// For each pose, the instances with which the shape there shares a point; likewise.
    Status find_overlaps(const PoseTestQuery& query, std::span<const Pose> poses,
                         InstanceLists& lists, const Limits& limits = {});

    /// Brings a table of pairs (world_pairs.hpp) up to date. Fails with invalid_query if its reach
    /// or query is invalid, if `limits` end the call, and as Context::run(); the table is empty
    /// then, unless the limits themselves are refused. Errors of single pairs are the status of
    /// their rows.
    Status update(PairTable<PenetrationQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<ContactQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<IntersectionQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<ClosestPointQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<SeparationQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<IntersectionTestQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<SeparationVectorQuery>& table, const Limits& limits = {});
    /// Likewise.
    Status update(PairTable<ContainmentQuery>& table, const Limits& limits = {});
    /// The times of impact while instances move: from time 0 to time 1, moving[i] goes from its
    /// pose to ends[i], as TimeOfImpactQuery describes it, and all others stand still. The
    /// instances keep their poses: a step that goes to its end is followed by move(moving, ends).
    /// If an instance is named twice, the later end counts. Also fails as move() does. Otherwise
    /// likewise.
    Status update(PairTable<TimeOfImpactQuery>& table, std::span<const InstanceHandle> moving,
                  std::span<const Pose> ends, const Limits& limits = {});

    /// Brings a table that the device fills (world_device.hpp) up to date and waits for the device.
    /// Fails with invalid_query if the query or reach is invalid; with unsupported_technique if the
    /// context has no pipelines of Technique::compute; with too_large if there are more than 2^18
    /// instances, or more pairs or points than the device has memory for; if `limits` end the call;
    /// and as Context::run(). The table is empty then, unless the limits themselves are refused.
    /// Errors of single pairs are the status of their rows.
    Status update(DevicePairTableBase& table, const Limits& limits = {});
    /// Does the first half of it: uploads what has changed, and lets the device begin. The second
    /// half is DevicePairTable::collect(); until then the table has no rows, and update() and
    /// submit() leave it alone and fail with not_ready. Instances and shapes may change meanwhile:
    /// the table describes them as they were. Otherwise likewise.
    Status submit(DevicePairTableBase& table, const Limits& limits = {});
    /// The same at poses that the host's commands write (device_poses.hpp), of all instances; those
    /// that the world keeps are neither used nor changed. Also fails with invalid_query if the
    /// buffer is not as it must be, and, once the device has looked, if a pose is none.
    Status update(DevicePairTableBase& table, const DevicePoses& poses, const Limits& limits = {});
    /// Likewise.
    Status submit(DevicePairTableBase& table, const DevicePoses& poses, const Limits& limits = {});
    /// Records what submit() submits into a command buffer of the host, which may submit it again
    /// and again: see DevicePairTable. Submits nothing and waits for nothing. Fails as submit()
    /// and, with invalid_submission, as Context::record(); nothing has been recorded then.
    Status record(DevicePairTableBase& table, const Recording& recording,
                  const Limits& limits = {});
    /// Likewise.
    Status record(DevicePairTableBase& table, const DevicePoses& poses, const Recording& recording,
                  const Limits& limits = {});
    /// False if a table has to be recorded (again): collect() found no room, or instances, filters
    /// or any shape of the context have changed since. Poses are not compared.
    [[nodiscard]] bool is_recorded(const DevicePairTableBase& table) const noexcept;

    /// Host memory of the instances and of all that is kept with them, in bytes. Scratch memory of
    /// the queries is not counted.
    [[nodiscard]] std::uint64_t memory_use() const noexcept;
    /// Gives back what is kept to make queries faster; the next queries make it again.
    void trim() noexcept;

private:
    class NEARFIELD_HIDDEN Implementation;
    explicit World(std::unique_ptr<Implementation> implementation) noexcept;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace nearfield
