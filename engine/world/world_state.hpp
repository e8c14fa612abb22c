#pragma once

#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/batch/context_implementation.hpp>
#include <engine/geometry/hilbert_curve.hpp>
#include <engine/solvers/time_of_impact.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/job_lists.hpp>
#include <engine/world/nearest_queries.hpp>
#include <engine/world/pose_queries.hpp>
#include <engine/world/ray_queries.hpp>
#include <engine/world/shape_edge_queries.hpp>
#include <engine/world/world_view.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_request.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// What a world consists of, and what its members share. Functions throw.
struct World::State {
    /// What one job needs. Kept, so that a frame like the one before allocates nothing.
    struct Job {
        world::PoseQueries poses;
        std::vector<geometry::TransformedPolygon> placed;
        world::NearestQueries nearest;
        world::ShapeEdgeQueries edges;
        world::RayQueries rays;
        std::vector<std::uint32_t> found;
        solvers::TimeOfImpactSolver impacts;
        solvers::Workspace workspace;
        AnyResult result;
    };

    explicit State(std::shared_ptr<Context::Implementation> of);

    /// Takes in what has changed in the world.
    void prepare();
    /// The same for a call, whose filter has to be one of this world.
    void prepare(const WorldFilter& filter, const char* call);
    [[nodiscard]] const geometry::Polygon& shape(ShapeHandle handle, const char* call) const;
    /// As tables of pairs see it.
    [[nodiscard]] WorldView view() { return {*context, identity, instances}; }
    /// Divides poses of a shape among the jobs: calls answer(job, placed, i) with the shape at pose
    /// i. Defined in poses.cpp.
    template <class Answer>
    void divide_poses(const geometry::Polygon& shape, const WorldFilter& filter,
                      std::span<const Pose> at, const Answer& answer);
    /// Answers each of `count` questions about places in an order in which neighbours need the same
    /// boxes, sorting `at_a_time` of them: calls answer(job, first, numbers) for the questions
    /// first + numbers[0], first + numbers[1], ... `place(i)` is where question i is.
    template <class Place, class Answer>
    void divide_places(std::size_t count, std::size_t at_a_time, const Place& place,
                       const Answer& answer);

    // Each defined where it is used.

    struct Casts;
    struct Lists;

    std::shared_ptr<Context::Implementation> context;
    // Another world may come to have the address of this one, but not its identity.
    std::shared_ptr<const void> identity = std::make_shared<char>();
    world::Instances instances;
    Jobs jobs;
    std::vector<Job> scratch;  // by job
    geometry::HilbertOrder hilbert_order;
    JobLists<RayHit> ray_lists;
    JobLists<InstanceHandle> instance_lists;
    // Of calls that the device answers at once.
    WorldRequest rays;
    WorldRequest points;
    WorldRequest poses;
};

template <class Place, class Answer>
void World::State::divide_places(std::size_t count, std::size_t at_a_time, const Place& place,
                                 const Answer& answer) {
    /// The number of places that a job takes at a time, which are in order along a curve.
    constexpr std::size_t part = 1024;
    expect_answers(count);
    for (std::size_t block = 0; block < count; block += at_a_time) {
        const std::size_t size = std::min(at_a_time, count - block);
        const auto order = hilbert_order.sort(
            size, [&](std::size_t i) -> const Vector2& { return place(block + i); });
        jobs.divide(size, part, [&](std::uint32_t job, std::size_t first, std::size_t end) {
            answer(scratch[job], block, order.subspan(first, end - first));
            finish_answers(end - first);
        });
    }
}

}  // namespace nearfield
