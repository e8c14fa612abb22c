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
/// A world: instances of shapes that stay from frame to frame, and queries about all of them. Input
/// and output are spans of flat structures in the caller's memory, one entry per pose, point or
/// segment. The last argument (WorldOptions) selects the instances considered, the limits of the
/// call and the technique.
///
/// Answers are exact up to the rounding stated by their error bounds, with Technique::cpu and
/// Technique::compute alike. What a world keeps between calls makes them faster and never changes
/// an answer: after any sequence of calls, each answer is the same, bit for bit, as in a new world
/// to which the present instances were added in the order of their adding.

namespace nearfield {

class PairTableBase;
class WorldRequest;

/// Instances of shapes of one context, kept from frame to frame.
///
/// A shape may be deformed (Context::update_shape) between any two calls; all its instances follow.
/// Boxes over a shape's edges and over all instances are made when a query needs them, and refitted
/// when something changes; a rigid move keeps those of the shape. Removing a shape from the context
/// removes its instances from all answers, for good.
///
/// Threads: as for the context, which every member uses; a world and its context count as one
/// object. Many poses, points, segments and pairs are divided among Settings::jobs. Results do not
/// depend on their number.
///
/// Lifetime: a world keeps what it needs of its context, whichever is destroyed first.
///
/// Errors: a call that fails does not change the world. Its output is undefined, except for a table
/// of pairs (update()). Invalid numbers in a query or pose are invalid_query, and the message names
/// the first; handles of shapes are unknown_shape, handles of instances unknown_instance.
///
/// Limits: every call can be given Limits (limits.hpp). If the limits end a call, it fails
/// (cancelled or budget_exhausted), so partial output is never taken for complete. The time for
/// making and refitting boxes counts, but has no checkpoints.
///
/// Techniques: a function that only the CPU answers refuses Technique::compute
/// (unsupported_technique). With Technique::compute a call also fails with unsupported_technique if
/// the context has no pipelines for it, with too_large if there are more instances or inputs than
/// WorldOptions::technique allows, and as Context::run().
///
///     nearfield::World world(context);
///     const auto crate = world.add({.shape = box, .pose = start});
///     nearfield::Status status = world.move(*crate, next);
///     std::vector<nearfield::RayHit> hits(segments.size());
///     status = world.cast_rays(segments, hits);
class NEARFIELD_EXPORT World {
public:
    /// Creates an empty world. Ends the program if memory runs out; call create() to handle that
    /// case.
    explicit World(Context& context) noexcept;
    /// Creates an empty world. Fails with out_of_memory.
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
    /// Moves an instance to another pose.
    Status move(InstanceHandle instance, const Pose& pose);
    /// Moves many instances: instances[i] gets poses[i]. If an instance is named twice, the later
    /// pose counts. Fails (invalid_query) if the spans differ in length.
    Status move(std::span<const InstanceHandle> instances, std::span<const Pose> poses);
    /// Changes the category and mask of an instance.
    Status set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask);
    /// Removes an instance. Its handle stays invalid from then on.
    Status remove(InstanceHandle instance);

    /// The instance as it is now.
    [[nodiscard]] Expected<WorldInstance> instance(InstanceHandle instance) const;
    /// The number of instances.
    [[nodiscard]] std::uint32_t size() const noexcept;

    /// Finds the first hit of each segment. If several hits coincide, the instance added first
    /// wins, then the edge of lowest index. Fails (invalid_query) if the spans differ in length.
    ///
    ///     std::vector<nearfield::RayHit> hits(segments.size());
    ///     const nearfield::WorldOptions options{.technique = nearfield::Technique::automatic};
    ///     const auto status = world.cast_rays(segments, hits, options);
    Status cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                     const WorldOptions& options = {});
    /// Finds all hits of each segment. A vertex where the segment passes from one edge to the next
    /// is one hit of each edge. An edge along the segment is hit where they first meet. Edges
    /// without length, between repeated vertices, are never hit. The CPU answers.
    ///
    ///     nearfield::RayHits all;
    ///     const auto status = world.cast_rays(segments, all);
    ///     for (std::uint32_t i = all.offsets[0]; i < all.offsets[1]; ++i) { use(all.hits[i]); }
    Status cast_rays(std::span<const Segment> segments, RayHits& hits,
                     const WorldOptions& options = {});

    /// Finds the nearest instances or edges of each point, in ascending order of
    /// NearestHit::distance. Instances that contain the point come first, the deepest at the head.
    /// Of equally near ones, the instance added first, then the edge of lower index comes first.
    /// Point i gets hits[i * count] to hits[i * count + count - 1]. Fails (invalid_query) if there
    /// are not `count` times as many hits as points, and with Technique::compute if `count` is not
    /// 1.
    ///
    ///     std::vector<nearfield::NearestHit> hits(3 * points.size());
    ///     const auto status = world.find_nearest({.count = 3, .max_distance = 2.0}, points, hits);
    Status find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                        std::span<NearestHit> hits, const WorldOptions& options = {});
    /// Finds the nearest instances of the shape at each pose, in ascending order of
    /// Clearance::distance. Each instance has the clearance that it would have alone in the world.
    /// Those that the shape intersects come first, the deepest at the head. Of equally near ones,
    /// the instance added first comes first. Pose i gets nearest[i * count] to nearest[i * count +
    /// count - 1]; where there are fewer, the rest name no instance and have an infinite distance.
    /// Fails (invalid_query) if there are not `count` times as many entries as poses. The CPU
    /// answers.
    ///
    ///     std::vector<nearfield::Clearance> nearest(2 * poses.size());
    ///     const auto status = world.find_nearest({.shape = robot, .count = 2}, poses, nearest);
    Status find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                        std::span<Clearance> nearest, const WorldOptions& options = {});
    /// Finds the nearest edges of all instances at each pose, in ascending order of
    /// ShapeEdgeHit::distance. Of equally near ones, the instance added first, then the edge of
    /// lower index comes first. Pose i gets hits[i * count] to hits[i * count + count - 1]; where
    /// there are fewer edges, the rest name no instance. Fails (invalid_query) if there are not
    /// `count` times as many hits as poses. The CPU answers.
    ///
    ///     std::vector<nearfield::ShapeEdgeHit> edges(8 * poses.size());
    ///     const auto status = world.find_nearest({.shape = robot, .count = 8}, poses, edges);
    Status find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                        std::span<ShapeEdgeHit> hits, const WorldOptions& options = {});

    /// Writes 1 for each pose at which the shape and an instance of the world share a point,
    /// otherwise 0. Exact up to the rounding of transformed vertices, as IntersectionTestQuery.
    /// Memory does not depend on the number of poses, unless the device answers. Fails
    /// (invalid_query) if the spans differ in length.
    ///
    ///     std::vector<std::uint8_t> blocked(poses.size());
    ///     const nearfield::WorldOptions options{.filter = {.ignored = handle_of_robot}};
    ///     const auto status = world.test_poses(robot, poses, blocked, options);
    Status test_poses(ShapeHandle shape, std::span<const Pose> poses,
                      std::span<std::uint8_t> intersects, const WorldOptions& options = {});
    /// Finds the least distance of the shape from the world at each pose. Neighbouring poses in
    /// sequence are faster than poses in random order. Exact up to the rounding of transformed
    /// vertices. Memory does not depend on the number of poses. Fails (invalid_query) if the spans
    /// differ in length. The CPU answers.
    ///
    ///     std::vector<nearfield::Clearance> clearances(poses.size());
    ///     const nearfield::ClearanceQuery query{.shape = robot, .max_clearance = 2.0};
    ///     const auto status = world.find_clearances(query, poses, clearances);
    Status find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                           std::span<Clearance> clearances, const WorldOptions& options = {});

    /// Finds when the shape first touches the world, for each motion. Fails (invalid_query) if the
    /// spans differ in length, or if the tolerance is too small for the coordinates near a motion;
    /// and as Context::run(), with ring_full if all batches are in flight. The CPU answers.
    ///
    ///     std::vector<nearfield::ShapeCastHit> hits(sweeps.size());
    ///     const auto status = world.cast_shape({.shape = robot, .tolerance = 1e-3}, sweeps, hits);
    Status cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                      std::span<ShapeCastHit> hits, const WorldOptions& options = {});

    /// Finds the instances with which each rectangle shares a point, exact up to the rounding of
    /// transformed vertices. The CPU answers.
    ///
    ///     nearfield::InstanceLists lists;
    ///     const auto status = world.find_overlaps(std::span(&window, 1), lists);
    ///     for (const auto& handle : lists.instances) { draw(handle); }
    Status find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                         const WorldOptions& options = {});
    /// Finds the instances that contain each point, or have it on their boundary up to rounding.
    /// The CPU answers.
    ///
    ///     nearfield::InstanceLists under;
    ///     const auto status = world.find_overlaps(std::span(&cursor, 1), under);
    Status find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                         const WorldOptions& options = {});
    /// Finds the instances with which the shape shares a point at each pose, exact up to the
    /// rounding of transformed vertices. The CPU answers.
    ///
    ///     nearfield::InstanceLists touched;
    ///     const auto status = world.find_overlaps(robot, poses, touched);
    Status find_overlaps(ShapeHandle shape, std::span<const Pose> poses, InstanceLists& lists,
                         const WorldOptions& options = {});

    /// Does the first half of cast_rays() with first hits; WorldRequest::collect() is the second
    /// half. Uploads the segments and the instances that have changed, and starts the device. With
    /// Technique::cpu it answers at once and keeps the hits. Nothing is borrowed when this returns.
    /// Fails as cast_rays(), and with not_ready if something was submitted by `request` and not
    /// collected. After any other error nothing is submitted.
    ///
    ///     nearfield::WorldRequest rays;  // kept from frame to frame
    ///     const nearfield::WorldOptions options{.technique = nearfield::Technique::compute};
    ///     auto status = world.submit(rays, segments, options);
    ///     step_the_rest();
    ///     status = status.ok() ? rays.collect(hits) : status;
    Status submit(WorldRequest& request, std::span<const Segment> segments,
                  const WorldOptions& options = {});
    /// Does the first half of find_nearest() for points; otherwise as for segments.
    ///
    ///     auto status = world.submit(request, {.max_distance = 2.0}, points);
    ///     status = status.ok() ? request.collect(nearest) : status;
    Status submit(WorldRequest& request, const NearestQuery& query, std::span<const Vector2> points,
                  const WorldOptions& options = {});
    /// Does the first half of test_poses(); otherwise as for segments.
    ///
    ///     auto status = world.submit(request, robot, poses);
    ///     status = status.ok() ? request.collect(blocked) : status;
    Status submit(WorldRequest& request, ShapeHandle shape, std::span<const Pose> poses,
                  const WorldOptions& options = {});

    /// Brings a table of pairs (world_pairs.hpp) up to date: submit() and PairTable::collect() in
    /// one. `input` has what the table needs besides the world. Fails with invalid_query if query,
    /// options or input are invalid or contradict each other; with unknown_instance if the input
    /// names an instance that does not exist; with not_ready if the table was submitted and not
    /// collected; if `limits` end the call; and as Context::run(). By Technique::compute also with
    /// unsupported_technique if the context has no pipelines for it, and with too_large if there
    /// are more instances than 2^18, or more pairs or points than the device has memory for. After
    /// any error except not_ready and invalid limits, the table is empty. Errors of single pairs
    /// are the status of their rows.
    Status update(PairTableBase& table, const PairTableInput& input = {},
                  const Limits& limits = {});
    /// Does the first half of update(): uploads what has changed and starts the device. With
    /// Technique::cpu it answers the pairs before it returns. PairTable::collect() is the second
    /// half; until then the table has no rows. Instances and shapes may change meanwhile: the table
    /// describes them as they were. Fails as update().
    Status submit(PairTableBase& table, const PairTableInput& input = {},
                  const Limits& limits = {});
    /// Records what submit() submits into a command buffer of the host, which may submit it any
    /// number of times: see PairTable. Submits nothing and waits for nothing. Fails as submit(),
    /// with invalid_submission as Context::record(), and with invalid_query if the table is
    /// answered by the CPU; nothing has been recorded then.
    Status record(PairTableBase& table, const Recording& recording,
                  const PairTableInput& input = {}, const Limits& limits = {});
    /// False if a table has to be recorded (again): collect() reported an overflow, or instances,
    /// their filters or their shapes are others than they were. Poses and other shapes do not
    /// count.
    [[nodiscard]] bool is_recorded(const PairTableBase& table) const noexcept;

    /// Host memory of the instances and of all that is kept with them, in bytes. Scratch memory of
    /// the queries is not counted.
    [[nodiscard]] std::uint64_t memory_use() const noexcept;
    /// Frees what is kept to make queries faster; the next queries make it again.
    void trim() noexcept;

private:
    friend class WorldRequest;
    struct NEARFIELD_HIDDEN State;
    explicit World(std::unique_ptr<State> state) noexcept;
    std::unique_ptr<State> state_;
};

}  // namespace nearfield
