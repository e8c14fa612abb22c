// One shape at many poses: whether and how it meets a world, and what is nearest to it.

#include <engine/device_input/pair_search.hpp>
#include <engine/geometry/angle_kernels.hpp>
#include <engine/world/pose_queries.hpp>
#include <engine/world/requests.hpp>
#include <nearfield/portable_math.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nearfield {
namespace {

using geometry::TransformedPolygon;
using geometry::kernels::angles_at_once;

/// Places a shape at each of at most `angles_at_once` poses.
void place_at(const geometry::Polygon& shape, std::span<const Pose> poses,
              std::vector<TransformedPolygon>& placed) {
    std::array<double, angles_at_once> angles{};
    std::array<SineCosine, angles_at_once> turns;
    std::transform(poses.begin(), poses.end(), angles.begin(),
                   [](const Pose& pose) { return pose.angle; });
    geometry::kernels::find_sines_cosines(std::span(angles).first(poses.size()), turns);
    placed.clear();
    for (std::size_t i = 0; i < poses.size(); ++i) {
        placed.emplace_back(shape, poses[i], turns[i]);
    }
}

}  // namespace

template <class Answer>
void World::State::divide_poses(const geometry::Polygon& shape, const WorldFilter& filter,
                                std::span<const Pose> at, const Answer& answer) {
    /// The number of poses that a job takes at a time: neighbours help each other.
    constexpr std::size_t part = 128;
    expect_answers(at.size());
    jobs.divide(at.size(), part, [&](std::uint32_t number, std::size_t first, std::size_t end) {
        Job& job = scratch[number];
        job.poses.begin(instances, shape, filter);
        for (std::size_t i = first; i < end; ++i) {
            checkpoint();
            const std::size_t of_some = (i - first) % angles_at_once;
            if (of_some == 0) {
                place_at(shape, at.subspan(i, std::min(angles_at_once, end - i)), job.placed);
            }
            answer(job, job.placed[of_some], i);
        }
        finish_answers(end - first);
    });
}

/// Poses of a shape, at each of which it meets an instance or not.
struct WorldRequest::Poses {
    ShapeHandle shape;
    const geometry::Polygon* polygon = nullptr;  // of the device's instances
    bool is_for_cpu = false;

    static constexpr device_input::WorldQuestion question = device_input::WorldQuestion::poses;
    static constexpr const char* call = "test_poses";
    using Input = Pose;
    using Answer = std::uint8_t;
    using Data = shaders::PoseData;
    using Found = std::uint32_t;
    using Solver = world::PoseQueries;

    static void require_room(const char* from, std::size_t poses, std::size_t answers) {
        require_lengths(from, "poses", poses, answers);
    }
    static std::uint32_t answers_each() { return 1; }
    void require(const World::State& world, std::span<const Pose> poses) const {
        static_cast<void>(world.shape(shape, call));
        require_poses(call, poses);
    }

    void answer(World::State& world, std::span<const Pose> poses,
                std::span<std::uint8_t> intersects, const WorldFilter& filter) const {
        world.divide_poses(
            world.shape(shape, call), filter, poses,
            [&](World::State::Job& job, const TransformedPolygon& placed, std::size_t i) {
                intersects[i] = job.poses.intersects(placed) ? 1 : 0;
            });
    }

    void take_down(State& device, shaders::WorldQueryPush& push) {
        const auto& shape_on_device = device.add_shape(shape);
        polygon = shape_on_device.polygon;
        is_for_cpu = shape_on_device.data.left_to_cpu != 0;
        push.shape = shape_on_device.data.shape;
        push.unit = shape_on_device.data.unit;
        push.radius = shape_on_device.data.radius;
    }
    [[nodiscard]] Data data_of(const State& device, const Pose& pose) const {
        shaders::SearchInstanceData placed;
        const double magnitude = device_input::set_place(*polygon, pose, sine_cosine(pose.angle),
                                                         device.instances().origin(), placed)
                                     .magnitude;
        Data data{placed.axis, placed.high, placed.low};
        // Single precision cannot tell anything if it does not hold the shape.
        data.rounding = is_for_cpu ? std::numeric_limits<float>::infinity()
                                   : device_input::rounding_at(magnitude);
        return data;
    }
    static bool decide(const State& /*device*/, const Pose& /*pose*/, Found found,
                       std::uint8_t& intersects) {
        intersects = found == 1 ? 1 : 0;
        return found <= 1;
    }

    void answer_some(world::PoseQueries& solver, const world::Instances& instances,
                     const WorldFilter& filter, std::span<const Pose> poses,
                     std::span<const std::uint32_t> numbers,
                     std::span<std::uint8_t> intersects) const {
        solver.begin(instances, *polygon, filter);
        for (const std::uint32_t number : numbers) {
            checkpoint();
            const TransformedPolygon placed(*polygon, poses[number]);
            intersects[number] = solver.intersects(placed) ? 1 : 0;
        }
    }
};

Status World::test_poses(ShapeHandle shape, std::span<const Pose> poses,
                         std::span<std::uint8_t> intersects, const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Poses>::answer(*state_, state_->poses, {shape}, poses,
                                                         intersects, options);
}

Status World::submit(WorldRequest& request, ShapeHandle shape, std::span<const Pose> poses,
                     const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Poses>::submit(*state_, request, {shape}, poses, options);
}

Status WorldRequest::collect(std::span<std::uint8_t> intersects, const Limits& limits) {
    return Of<Poses>::collect(*this, intersects, limits);
}

Status World::find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                              std::span<Clearance> clearances, const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        constexpr const char* call = "find_clearances";
        require_cpu(call, options.technique);
        require_lengths(call, "poses", poses.size(), clearances.size());
        const geometry::Polygon& polygon = state_->shape(query.shape, call);
        if (!(query.max_clearance >= 0.0 && query.min_clearance < query.max_clearance)) {
            refuse(call, "the clearances from " + geometry::number(query.min_clearance) + " to " +
                             geometry::number(query.max_clearance) +
                             " are no range that ends at 0 or above");
        }
        require_poses(call, poses);
        state_->prepare(options.filter, call);
        state_->divide_poses(polygon, options.filter, poses,
                             [&](State::Job& job, const TransformedPolygon& placed, std::size_t i) {
                                 clearances[i] = job.poses.clearance(placed, query);
                             });
    });
}

Status World::find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                           std::span<Clearance> nearest, const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        constexpr const char* call = "find_nearest";
        require_cpu(call, options.technique);
        require_room_for_nearest(call, query.count, "poses", poses.size(), nearest.size());
        require_reach_of_nearest(query.max_distance);
        const geometry::Polygon& polygon = state_->shape(query.shape, call);
        require_poses(call, poses);
        state_->prepare(options.filter, call);
        state_->divide_poses(polygon, options.filter, poses,
                             [&](State::Job& job, const TransformedPolygon& placed, std::size_t i) {
                                 job.poses.find_nearest(
                                     placed, query.max_distance,
                                     nearest.subspan(i * query.count, query.count));
                             });
    });
}

Status World::find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                           std::span<ShapeEdgeHit> hits, const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        constexpr const char* call = "find_nearest";
        require_cpu(call, options.technique);
        require_room_for_nearest(call, query.count, "poses", poses.size(), hits.size());
        require_reach_of_nearest(query.max_distance);
        const geometry::Polygon& polygon = state_->shape(query.shape, call);
        require_poses(call, poses);
        state_->prepare(options.filter, call);
        for (State::Job& job : state_->scratch) {
            job.edges.begin(state_->instances, options.filter);
        }
        state_->divide_poses(polygon, options.filter, poses,
                             [&](State::Job& job, const TransformedPolygon& placed, std::size_t i) {
                                 job.edges.find(placed, query.max_distance,
                                                hits.subspan(i * query.count, query.count));
                             });
    });
}

}  // namespace nearfield
