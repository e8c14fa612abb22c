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
/// A world: instances of shapes that stay from frame to frame, and questions that name the world
/// instead of two shapes. Input and output are spans of flat structures, one entry per pose, point
/// or segment, in the caller's memory; the last argument says which instances are considered, what
/// limits the call, and who answers (WorldOptions).
///
/// Answers are exact up to the rounding that each one's error bound states, whoever gives them.
/// What a world keeps between calls makes them faster and never changes an answer: after any
/// sequence of calls, each answer is the same, bit for bit, as in a new world to which the present
/// instances were added in the order of their adding.

namespace nearfield {

class PairTableBase;
class WorldRequest;

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
/// Limits: every call can be given Limits (limits.hpp). If they end it, it fails (cancelled or
/// budget_exhausted), so that no output looks whole that is not. The time that a world takes to
/// make and refit boxes counts; it is not divided by checkpoints.
///
/// Techniques: what the CPU alone answers refuses Technique::compute (unsupported_technique). Where
/// the device is asked, a call also fails with unsupported_technique if the context has no
/// pipelines of Technique::compute, with too_large if there are more instances or inputs than it
/// takes (WorldOptions::technique), and as Context::run().
///
///     nearfield::World world(context);
///     const auto crate = world.add({.shape = box, .pose = start});
///     nearfield::Status status = world.move(*crate, next);
///     std::vector<nearfield::RayHit> hits(segments.size());
///     status = world.cast_rays(segments, hits);
class NEARFIELD_EXPORT World {
public:
    /// An empty world. The program ends if there is no memory for it: where that has to be
    /// handled, call create().
    explicit World(Context& context) noexcept;
    /// An empty world. Fails with out_of_memory.
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

    /// For each segment, the first hit. Of several at the same place, the one of the instance added
    /// first, at its edge of lowest index. Fails (invalid_query) if the spans differ in length.
    ///
    ///     std::vector<nearfield::RayHit> hits(segments.size());
    ///     const nearfield::WorldOptions options{.technique = nearfield::Technique::automatic};
    ///     const auto status = world.cast_rays(segments, hits, options);
    Status cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                     const WorldOptions& options = {});
    /// For each segment, all hits. A vertex where the segment passes from one edge to the next is
    /// one hit of each. An edge along the segment is hit where they first meet. Edges without
    /// length, between repeated vertices, are never hit. The CPU answers.
    ///
    ///     nearfield::RayHits all;
    ///     const auto status = world.cast_rays(segments, all);
    ///     for (std::uint32_t i = all.offsets[0]; i < all.offsets[1]; ++i) { use(all.hits[i]); }
    Status cast_rays(std::span<const Segment> segments, RayHits& hits,
                     const WorldOptions& options = {});

    /// For each point, the nearest instances or edges in ascending order of NearestHit::distance:
    /// the instances that the point is inside come first, the deepest at the head. Of equally near
    /// ones, the instance added first, then the edge of lower index comes first. Point i gets
    /// hits[i * count] to hits[i * count + count - 1]. Fails (invalid_query) if there are not
    /// `count` times as many hits as points, and with Technique::compute if `count` is not 1.
    ///
    ///     std::vector<nearfield::NearestHit> hits(3 * points.size());
    ///     const auto status = world.find_nearest({.count = 3, .max_distance = 2.0}, points, hits);
    Status find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                        std::span<NearestHit> hits, const WorldOptions& options = {});
    /// For each pose, the nearest instances of the shape there in ascending order of
    /// Clearance::distance, each with its own clearance, as if it were alone in the world: those
    /// that the shape intersects come first, the deepest at the head. Of equally near ones, the
    /// instance added first comes first. Pose i gets nearest[i * count] to
    /// nearest[i * count + count - 1]; where there are fewer, the rest name no instance and have an
    /// infinite distance. Fails (invalid_query) if there are not `count` times as many entries as
    /// poses. The CPU answers.
    ///
    ///     std::vector<nearfield::Clearance> nearest(2 * poses.size());
    ///     const auto status = world.find_nearest({.shape = robot, .count = 2}, poses, nearest);
    Status find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                        std::span<Clearance> nearest, const WorldOptions& options = {});
    /// For each pose, the nearest edges of all instances in ascending order of
    /// ShapeEdgeHit::distance. Of equally near ones, the instance added first, then the edge of
    /// lower index comes first. Pose i gets hits[i * count] to hits[i * count + count - 1], of
    /// which those that were not found name no instance. Fails (invalid_query) if there are not
    /// `count` times as many hits as poses. The CPU answers.
    ///
    ///     std::vector<nearfield::ShapeEdgeHit> edges(8 * poses.size());
    ///     const auto status = world.find_nearest({.shape = robot, .count = 8}, poses, edges);
    Status find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                        std::span<ShapeEdgeHit> hits, const WorldOptions& options = {});

    /// For each pose, 1 if the shape there and an instance of the world share a point, otherwise 0.
    /// Exact up to the rounding of transformed vertices, as IntersectionTestQuery. Memory does not
    /// depend on the number of poses, unless the device answers. Fails (invalid_query) if the spans
    /// differ in length.
    ///
    ///     std::vector<std::uint8_t> blocked(poses.size());
    ///     const nearfield::WorldOptions options{.filter = {.ignored = handle_of_robot}};
    ///     const auto status = world.test_poses(robot, poses, blocked, options);
    Status test_poses(ShapeHandle shape, std::span<const Pose> poses,
                      std::span<std::uint8_t> intersects, const WorldOptions& options = {});
    /// For each pose, the least distance of the shape there from the world. Neighbouring poses in
    /// sequence are faster than poses in random order. Exact up to the rounding of transformed
    /// vertices. Memory does not depend on the number of poses. Fails (invalid_query) if the spans
    /// differ in length. The CPU answers.
    ///
    ///     std::vector<nearfield::Clearance> clearances(poses.size());
    ///     const nearfield::ClearanceQuery query{.shape = robot, .max_clearance = 2.0};
    ///     const auto status = world.find_clearances(query, poses, clearances);
    Status find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                           std::span<Clearance> clearances, const WorldOptions& options = {});

    /// For each motion of a shape, when it first touches the world. Fails (invalid_query) if the
    /// spans differ in length, or if the tolerance is too small for the coordinates of what a
    /// motion comes near; and as Context::run(), with ring_full if all batches are in flight. The
    /// CPU answers.
    ///
    ///     std::vector<nearfield::ShapeCastHit> hits(sweeps.size());
    ///     const auto status = world.cast_shape({.shape = robot, .tolerance = 1e-3}, sweeps, hits);
    Status cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                      std::span<ShapeCastHit> hits, const WorldOptions& options = {});

    /// For each rectangle, the instances with which it shares a point, exact up to the rounding of
    /// transformed vertices. The CPU answers.
    ///
    ///     nearfield::InstanceLists lists;
    ///     const auto status = world.find_overlaps(std::span(&window, 1), lists);
    ///     for (const auto& handle : lists.instances) { draw(handle); }
    Status find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                         const WorldOptions& options = {});
    /// For each point, the instances that it lies in, or up to rounding on the boundary of. The CPU
    /// answers.
    ///
    ///     nearfield::InstanceLists under;
    ///     const auto status = world.find_overlaps(std::span(&cursor, 1), under);
    Status find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                         const WorldOptions& options = {});
    /// For each pose, the instances with which the shape there shares a point, exact up to the
    /// rounding of transformed vertices. The CPU answers.
    ///
    ///     nearfield::InstanceLists touched;
    ///     const auto status = world.find_overlaps(robot, poses, touched);
    Status find_overlaps(ShapeHandle shape, std::span<const Pose> poses, InstanceLists& lists,
                         const WorldOptions& options = {});

    /// Does the first half of cast_rays() with first hits, of which WorldRequest::collect() is the
    /// second: uploads the segments, and what has changed of the instances, and lets the device
    /// begin, or, with Technique::cpu, answers and keeps the hits. Nothing is borrowed when this
    /// returns. Fails as cast_rays(), and with not_ready if something was submitted by `request`
    /// and not collected. After any other error nothing is submitted.
    ///
    ///     nearfield::WorldRequest rays;  // kept from frame to frame
    ///     const nearfield::WorldOptions options{.technique = nearfield::Technique::compute};
    ///     auto status = world.submit(rays, segments, options);
    ///     step_the_rest();
    ///     status = status.ok() ? rays.collect(hits) : status;
    Status submit(WorldRequest& request, std::span<const Segment> segments,
                  const WorldOptions& options = {});
    /// Does the first half of find_nearest() for points, as for segments.
    ///
    ///     auto status = world.submit(request, {.max_distance = 2.0}, points);
    ///     status = status.ok() ? request.collect(near) : status;
    Status submit(WorldRequest& request, const NearestQuery& query, std::span<const Vector2> points,
                  const WorldOptions& options = {});
    /// Does the first half of test_poses(), as for segments.
    ///
    ///     auto status = world.submit(request, robot, poses);
    ///     status = status.ok() ? request.collect(blocked) : status;
    Status submit(WorldRequest& request, ShapeHandle shape, std::span<const Pose> poses,
                  const WorldOptions& options = {});

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
    friend class WorldRequest;
    struct NEARFIELD_HIDDEN State;
    explicit World(std::unique_ptr<State> state) noexcept;
    std::unique_ptr<State> state_;
};

}  // namespace nearfield
