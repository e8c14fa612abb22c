#pragma once

#include <engine/base/jobs.hpp>
#include <engine/context/implementation.hpp>
#include <engine/context/job_lists.hpp>
#include <engine/context/world_view.hpp>
#include <engine/world/hilbert_curve.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/nearest_queries.hpp>
#include <engine/world/overlap_queries.hpp>
#include <engine/world/pose_queries.hpp>
#include <engine/world/ray_queries.hpp>
#include <engine/world/shape_edge_queries.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_device_queries.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// What a world consists of. Its members are those of the public class, and throw.
class World::Implementation {
public:
    explicit Implementation(Context::Implementation& context);

    [[nodiscard]] InstanceHandle add(const WorldInstance& instance);
    void move(std::span<const InstanceHandle> instances, std::span<const Pose> poses);
    void set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask);
    void remove(InstanceHandle instance);
    [[nodiscard]] WorldInstance instance(InstanceHandle instance) const;
    [[nodiscard]] std::uint32_t size() const { return instances_.count(); }

    void test_poses(const PoseTestQuery& query, std::span<const Pose> poses,
                    std::span<std::uint8_t> intersects);
    void find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                         std::span<Clearance> clearances);
    void find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                      std::span<NearestHit> hits);
    void find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                      std::span<Clearance> nearest);
    void find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                      std::span<ShapeEdgeHit> hits);
    void cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                   const WorldFilter& filter);
    void cast_rays(std::span<const Segment> segments, RayHits& hits, const WorldFilter& filter);
    void cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                    std::span<ShapeCastHit> hits);
    void find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                       const WorldFilter& filter);
    void find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                       const WorldFilter& filter);
    void find_overlaps(const PoseTestQuery& query, std::span<const Pose> poses,
                       InstanceLists& lists);

    void submit(DeviceRays& rays, std::span<const Segment> segments, const WorldFilter& filter);
    void cast_rays(DeviceRays& rays, std::span<const Segment> segments, std::span<RayHit> hits,
                   const WorldFilter& filter);
    void submit(DeviceNearest& nearest, const NearestQuery& query, std::span<const Vector2> points);
    void find_nearest(DeviceNearest& nearest, const NearestQuery& query,
                      std::span<const Vector2> points, std::span<NearestHit> hits);
    void submit(DevicePoseTests& tests, const PoseTestQuery& query, std::span<const Pose> poses);
    void test_poses(DevicePoseTests& tests, const PoseTestQuery& query, std::span<const Pose> poses,
                    std::span<std::uint8_t> intersects);
    /// As tables of pairs see it.
    [[nodiscard]] WorldView view() { return {*context_, identity_, instances_}; }

    [[nodiscard]] std::uint64_t bytes() const;
    void trim();

private:
    /// What one job needs. Kept, so that a frame like the one before allocates nothing.
    struct Job {
        world::PoseQueries poses;
        std::vector<geometry::TransformedPolygon> placed;
        world::NearestQueries nearest;
        world::ShapeEdgeQueries edges;
        world::RayQueries rays;
        world::OverlapQueries overlaps;
        std::vector<std::uint32_t> found;
    };
    /// What a query of the batch is about: a sweep by its number, and an instance.
    struct Candidate {
        std::size_t number;
        std::uint32_t instance;
    };

    [[nodiscard]] Instance instance_of(std::uint32_t index) const {
        return {instances_[index].shape, instances_[index].pose};
    }
    /// Answers the queries of the batch.
    void run_batch();
    /// Takes in what has changed in the world.
    void prepare();
    /// The same for a query, whose filter has to be one of this world.
    void prepare(const WorldFilter& filter, const char* call);
    [[nodiscard]] const geometry::Polygon& shape(ShapeHandle handle, const char* call) const;
    /// Answers each of `count` questions about places in an order in which neighbours need the same
    /// boxes, sorting `at_a_time` of them: calls answer(job, first, numbers) for the questions
    /// first + numbers[0], first + numbers[1], ... `place(i)` is where question i is.
    template <class Place, class Answer>
    void divide_places(std::size_t count, std::size_t at_a_time, const Place& place,
                       const Answer& answer);
    /// Divides poses of a shape among the jobs: calls answer(job, placed, i) with the shape at pose
    /// i.
    template <class Answer>
    void divide_poses(const geometry::Polygon& shape, const WorldFilter& filter,
                      std::span<const Pose> poses, const Answer& answer);
    /// Writes one list per entry; `find(job, i, found)` appends the instances of entry i, in any
    /// order.
    template <class Find>
    void write_lists(std::size_t count, InstanceLists& lists, const Find& find);
    /// Appends the instances that a sweep may touch, in any order.
    void find_candidates(const ShapeCastQuery& query, const geometry::Polygon& shape,
                         const Sweep& sweep, std::vector<std::uint32_t>& found) const;
    void add_candidate(const ShapeCastQuery& query, const Sweep& sweep, std::size_t number,
                       std::uint32_t index);
    /// Casts some sweeps, of which `first` is the number of the first, at their candidates.
    void cast_among_candidates(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                               std::size_t first, std::span<ShapeCastHit> hits);
    void answer_candidates(std::span<ShapeCastHit> hits);

    Context::Implementation* context_;
    // Another world may come to have the address of this one, but not its identity.
    std::shared_ptr<const void> identity_ = std::make_shared<char>();
    world::Instances instances_;
    Jobs jobs_;
    std::vector<Job> scratch_;  // by job
    world::HilbertOrder hilbert_order_;
    Batch batch_;  // of shape casts
    Results results_;
    std::vector<Candidate> candidates_;  // by query of the batch
    JobLists<RayHit> ray_lists_;
    JobLists<InstanceHandle> instance_lists_;
    // Of shape casts: the instances that each of some sweeps may touch.
    JobLists<std::uint32_t> candidate_lists_;
    std::vector<std::uint32_t> candidate_offsets_;
    std::vector<std::uint32_t> candidates_of_sweeps_;
};

}  // namespace nearfield
