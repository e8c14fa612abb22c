#pragma once

#include <nearfield/limits.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// \file
/// Instances of a world, and the inputs and answers of its queries (world.hpp). Each structure is
/// one entry; a caller passes flat arrays of them.

namespace nearfield {

struct DevicePoses;
struct PairTarget;

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

/// The last argument of a world's functions with many inputs.
struct WorldOptions {
    WorldFilter filter = {};  ///< the instances considered
    Limits limits = {};       ///< of this call
    /// The technique that answers. The answers are the same, bit for bit.
    /// - Technique::cpu answers everything.
    /// - Technique::compute answers World::cast_rays() with first hits, World::find_nearest() of
    ///   points with a NearestQuery::count of 1, and World::test_poses(). The device walks over
    ///   boxes in single precision and names the edges that may decide the answer; the CPU computes
    ///   the answer from these in double precision, and answers alone where single precision cannot
    ///   tell. There may be at most 2^18 instances, and as many inputs as Settings::memory_limit
    ///   allows and a buffer of the device holds: at least 4 million, at 32 bytes an answer. A
    ///   hardware device is faster from about a thousand inputs on.
    /// - Technique::automatic is Technique::compute for thousands of inputs that a hardware device
    ///   can answer, otherwise Technique::cpu.
    /// - Technique::raster answers nothing of a world (unsupported_technique).
    Technique technique = Technique::cpu;
};

/// One shape at many poses: World::find_clearances().
struct ClearanceQuery {
    ShapeHandle shape = {};  ///< of the world's context
    /// Clearances of at most this are not distinguished, which saves time: the answer is this
    /// value, and no instance. World units.
    double min_clearance = -std::numeric_limits<double>::infinity();
    /// Instances farther away than this are not considered, which saves time: if there is no other,
    /// the answer is this value, and no instance. World units, >= 0 and above `min_clearance`.
    double max_clearance = std::numeric_limits<double>::infinity();
};

/// The least distance of a shape at one pose from the instances of a world. Of several that are
/// equally near, the instance added first counts.
struct Clearance {
    /// World units. Positive: the least distance of the shape from any instance. Otherwise the
    /// shape intersects instances: minus the depth of the deepest vertex, of the shape in any of
    /// them or of any of them in the shape; 0 if boundaries cross and no vertex is inside.
    double distance = std::numeric_limits<double>::infinity();
    /// Of `distance`, if there is an instance: rounding plus the shapes' deviations.
    double error_bound = 0.0;
    /// The nearest instance, or the one with the deepest vertex; none if `distance` is one of the
    /// limits of the query.
    InstanceHandle instance = {};
    Vector2 point = {};    ///< of the shape, where it is nearest or deepest; needs `direction`
    Vector2 nearest = {};  ///< of the instance, where it is nearest or deepest; needs `direction`
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
    std::uint32_t count = 1;  ///< the number wanted per pose, >= 1
    /// Instances farther away than this are not considered. World units, >= 0.
    double max_distance = std::numeric_limits<double>::infinity();
};

/// The nearest edges of one shape at many poses: World::find_nearest().
struct ShapeEdgeQuery {
    ShapeHandle shape = {};   ///< of the world's context
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
    double tolerance = 0.0;         ///< as TimeOfImpactQuery::tolerance
    double contact_distance = 0.0;  ///< as TimeOfImpactQuery::contact_distance
};

/// When a moving shape first touches a world.
struct ShapeCastHit {
    ImpactState state = ImpactState::separated;  ///< the outcome
    /// The instance touched first; none if separated. Of several, one touched at the start comes
    /// first, then the one added first.
    InstanceHandle instance = {};
    double time = 1.0;              ///< as TimeOfImpactResult::time: never late
    double time_error_bound = 0.0;  ///< as TimeOfImpactResult::time_error_bound
    double error_bound = 0.0;       ///< as ResultSummary::error_bound of a TimeOfImpactResult
    Vector2 point = {};             ///< of the moving shape at `time`, nearest to `instance`
    Vector2 nearest = {};           ///< of `instance`, nearest to `point`
    Vector2 direction = {};  ///< unit vector from `point` to `nearest`; (0, 0) where they meet
};

/// The input of a PairTable's update, besides the world. Members that its query and options do not
/// use stay empty. Borrowed during the call.
struct PairTableInput {
    std::span<const InstanceHandle> a = {};  ///< PairTableOptions::listed: of pair i, its `a`
    std::span<const InstanceHandle> b = {};  ///< the same number of them: its `b`
    /// For times of impact, the instances that move from time 0 to time 1, as TimeOfImpactQuery
    /// describes it. All others stand still. The update does not change poses: a step that is
    /// completed is followed by World::move(moving, ends).
    std::span<const InstanceHandle> moving = {};
    /// The pose that moving[i] goes to. If an instance is named twice, its later one counts.
    std::span<const Pose> ends = {};
    /// By Technique::compute: the poses of all instances, which the host's commands write on the
    /// device (device_poses.hpp). The world's own poses are then neither used nor changed. Null:
    /// the world's own poses count.
    const DevicePoses* poses = nullptr;
    /// Of a query with `on_device`: the host's buffers that results on the device go to
    /// (pairs_on_device.hpp). Null: nearfield's own. One that cannot be written is refused
    /// (invalid_query).
    const PairTarget* target = nullptr;
};

}  // namespace nearfield
