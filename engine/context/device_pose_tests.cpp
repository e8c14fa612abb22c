// Poses of a shape that the device tests for intersections.

#include <engine/base/interruption.hpp>
#include <engine/context/call_within.hpp>
#include <engine/context/device_query_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/plan/pair_search.hpp>
#include <engine/world/pose_queries.hpp>
#include <nearfield/portable_math.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

struct DevicePoseTests::Tests : State {
    Tests() : State(plan::WorldQuestion::poses) {}

    void submit(ContextOnDevice& with, const WorldOnDevice& world, const PoseTestQuery& query,
                std::span<const Pose> poses);
    void collect(const char* call, std::span<std::uint8_t> intersects);

private:
    void write(std::size_t i, std::byte* memory) const;
    void test_by_cpu(std::span<const std::uint32_t> left, std::span<std::uint8_t> intersects);

    const geometry::Polygon* shape_ = nullptr;
    bool is_for_cpu_ = false;
    std::vector<Pose> poses_;
    std::vector<world::PoseQueries> queries_;  // by job
};

void DevicePoseTests::Tests::write(std::size_t i, std::byte* memory) const {
    const Pose& pose = poses_[i];
    plan::SearchInstanceData placed;
    const double magnitude =
        plan::set_place(*shape_, pose, sine_cosine(pose.angle), instances().origin(), placed)
            .magnitude;
    plan::PoseData data{placed.axis, placed.high, placed.low};
    // Single precision cannot tell anything if it does not hold the shape.
    data.rounding =
        is_for_cpu_ ? std::numeric_limits<float>::infinity() : plan::rounding_at(magnitude);
    std::memcpy(memory + i * sizeof(data), &data, sizeof(data));
}

void DevicePoseTests::Tests::submit(ContextOnDevice& with, const WorldOnDevice& world,
                                    const PoseTestQuery& query, std::span<const Pose> poses) {
    require_poses("test_poses", poses);
    world.instances.require_own(query.filter.ignored, "test_poses");
    State::submit(
        "test_poses", with, world, query.filter, poses.size(), {},
        [&](plan::WorldQueryPush& push) {
            poses_.assign(poses.begin(), poses.end());
            const auto& shape = add_shape(query.shape);
            shape_ = shape.polygon;
            is_for_cpu_ = shape.data.left_to_cpu != 0;
            push.shape = shape.data.shape;
            push.unit = shape.data.unit;
            push.radius = shape.data.radius;
        },
        [&](std::size_t i, std::byte* memory) { write(i, memory); });
}

void DevicePoseTests::Tests::test_by_cpu(std::span<const std::uint32_t> left,
                                         std::span<std::uint8_t> intersects) {
    const world::Instances& all = instances_for_cpu();
    const WorldFilter filter = filter_for_cpu();
    queries_.resize(jobs().count());
    jobs().divide(left.size(), questions_of_part,
                  [&](std::uint32_t job, std::size_t first, std::size_t end) {
                      queries_[job].begin(all, *shape_, filter);
                      for (const std::uint32_t number : left.subspan(first, end - first)) {
                          checkpoint();
                          const geometry::TransformedPolygon placed(*shape_, poses_[number]);
                          intersects[number] = queries_[job].intersects(placed) ? 1 : 0;
                      }
                  });
}

void DevicePoseTests::Tests::collect(const char* call, std::span<std::uint8_t> intersects) {
    require_submitted(call);
    require_lengths(call, "poses", count, intersects.size());
    State::collect<std::uint32_t>(
        [&](std::size_t i, const std::uint32_t* answer) {
            intersects[i] = answer != nullptr && *answer == 1 ? 1 : 0;
            return answer == nullptr || *answer <= 1;
        },
        [&](std::span<const std::uint32_t> left) { test_by_cpu(left, intersects); });
}

DevicePoseTests::DevicePoseTests() : DeviceQueryBase(std::make_unique<Tests>()) {}

Status DevicePoseTests::collect(std::span<std::uint8_t> intersects, const Limits& limits) {
    return catch_within(limits,
                        [&] { static_cast<Tests&>(*state_).collect("collect", intersects); });
}

void World::Implementation::submit(DevicePoseTests& tests, const PoseTestQuery& query,
                                   std::span<const Pose> poses) {
    static_cast<void>(shape(query.shape, "test_poses"));
    static_cast<DevicePoseTests::Tests&>(*tests.state_)
        .submit(*context_, {identity_, instances_}, query, poses);
}

void World::Implementation::test_poses(DevicePoseTests& tests, const PoseTestQuery& query,
                                       std::span<const Pose> poses,
                                       std::span<std::uint8_t> intersects) {
    require_lengths("test_poses", "poses", poses.size(), intersects.size());
    submit(tests, query, poses);
    static_cast<DevicePoseTests::Tests&>(*tests.state_).collect("test_poses", intersects);
}

Status World::submit(DevicePoseTests& tests, const PoseTestQuery& query,
                     std::span<const Pose> poses, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->submit(tests, query, poses); });
}

Status World::test_poses(DevicePoseTests& tests, const PoseTestQuery& query,
                         std::span<const Pose> poses, std::span<std::uint8_t> intersects,
                         const Limits& limits) {
    return catch_within(limits,
                        [&] { implementation_->test_poses(tests, query, poses, intersects); });
}

}  // namespace nearfield
