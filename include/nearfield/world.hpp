#pragma once

#include <nearfield/context.hpp>
#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>
#include <nearfield/world_queries.hpp>

#include <cstdint>
#include <memory>
#include <span>

/// \file
/// A world: instances of shapes that stay from frame to frame, and queries that name the world
/// instead of two shapes. Input and output are spans of flat structures, one entry per pose, point
/// or segment, in the caller's memory.
///
/// Queries of a world are answered on the CPU, except for tables of pairs that the device fills
/// (world_pairs.hpp) and many rays, points or poses that it is asked about
/// (world_device_queries.hpp), exact up to the rounding that each answer's error bound states. What
/// a world keeps between queries makes them faster and never changes an answer: after any sequence
/// of calls, each answer is the same, bit for bit, as in a new world to which the present instances
/// were added in the order of their adding.

namespace nearfield {

class PairTableBase;
class DeviceRays;
class DeviceNearest;
class DevicePoseTests;

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

    /// The same by the device (world_device_queries.hpp), and waits for it. Also fails with
    /// unsupported_technique if the context has no pipelines of Technique::compute, with too_large
    /// if there are more instances or poses than DeviceQueryBase allows, with not_ready if `tests`
    /// was submitted and not collected, and as Context::run().
    Status test_poses(DevicePoseTests& tests, const PoseTestQuery& query,
                      std::span<const Pose> poses, std::span<std::uint8_t> intersects,
                      const Limits& limits = {});
    /// Does the first half of it: uploads the poses, and what has changed of the instances, and
    /// lets the device begin. The second half is DevicePoseTests::collect(). Poses, instances and
    /// shapes may change meanwhile: answers are those of the world as it was. Otherwise likewise.
    Status submit(DevicePoseTests& tests, const PoseTestQuery& query, std::span<const Pose> poses,
                  const Limits& limits = {});

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

    /// The same by the device (world_device_queries.hpp), of which `count` is 1, and waits for it.
    /// Also fails with invalid_query if it is not, with unsupported_technique if the context has no
    /// pipelines of Technique::compute, with too_large if there are more instances or points than
    /// DeviceQueryBase allows, with not_ready if `nearest` was submitted and not collected, and as
    /// Context::run().
    Status find_nearest(DeviceNearest& nearest, const NearestQuery& query,
                        std::span<const Vector2> points, std::span<NearestHit> hits,
                        const Limits& limits = {});
    /// Does the first half of it: uploads the points, and what has changed of the instances, and
    /// lets the device begin. The second half is DeviceNearest::collect(). Points, instances and
    /// shapes may change meanwhile: hits are those of the world as it was. Otherwise likewise.
    Status submit(DeviceNearest& nearest, const NearestQuery& query,
                  std::span<const Vector2> points, const Limits& limits = {});

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

    /// The same by the device (world_device_queries.hpp), and waits for it. Also fails with
    /// unsupported_technique if the context has no pipelines of Technique::compute, with too_large
    /// if there are more instances or segments than DeviceQueryBase allows, with not_ready if
    /// `rays` was submitted and not collected, and as Context::run().
    Status cast_rays(DeviceRays& rays, std::span<const Segment> segments, std::span<RayHit> hits,
                     const WorldFilter& filter = {}, const Limits& limits = {});
    /// Does the first half of it: uploads the segments, and what has changed of the instances, and
    /// lets the device begin. The second half is DeviceRays::collect(). Segments, instances and
    /// shapes may change meanwhile: hits are those of the world as it was. Otherwise likewise.
    Status submit(DeviceRays& rays, std::span<const Segment> segments,
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

    /// Brings a table of pairs (world_pairs.hpp) up to date: submit() and PairTable::collect() in
    /// one. `input`: what the table is told besides. Fails with invalid_query if query, options or
    /// input are invalid or do not fit each other; with unknown_instance, if the input names one
    /// that is none; with not_ready if the table was submitted and not collected; if `limits` end
    /// the call; and as Context::run(). By Technique::compute also with unsupported_technique if
    /// the context has no pipelines for it, and with too_large if there are more instances than
    /// 2^18, or more pairs or points than the device has memory for. After an error but not_ready,
    /// and but for limits that are refused themselves, the table is empty. Errors of single pairs
    /// are the status of their rows.
    Status update(PairTableBase& table, const PairTableInput& input = {},
                  const Limits& limits = {});
    /// Does the first half of it: uploads what has changed, and lets the device begin; or, by
    /// Technique::cpu, answers the pairs. The second half is PairTable::collect(); until then the
    /// table has no rows. Instances and shapes may change meanwhile: the table describes them as
    /// they were. Fails as update().
    Status submit(PairTableBase& table, const PairTableInput& input = {},
                  const Limits& limits = {});
    /// Records what submit() submits into a command buffer of the host, which may submit it again
    /// and again: see PairTable. Submits nothing and waits for nothing. Fails as submit(), with
    /// invalid_submission as Context::record(), and with invalid_query if the table is answered by
    /// the CPU; nothing has been recorded then.
    Status record(PairTableBase& table, const Recording& recording,
                  const PairTableInput& input = {}, const Limits& limits = {});
    /// False if a table has to be recorded (again): collect() found no room, or instances, filters
    /// or any shape of the context have changed since. Poses are not compared.
    [[nodiscard]] bool is_recorded(const PairTableBase& table) const noexcept;

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
