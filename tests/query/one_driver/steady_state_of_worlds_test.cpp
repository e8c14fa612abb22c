#include <tests/query/steady_state.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/pair_tables.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace nearfield::test {
namespace {

using SteadyStateOfWorlds = SteadyStateTest;

TEST_F(SteadyStateOfWorlds, DevicePairsOfMovingInstancesAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<InstanceHandle> instances;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto instance = world->add({.shape = shapes[i % 2], .pose = {}});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        instances.push_back(*instance);
    }
    PairTable<PenetrationQuery> table({.tolerance = 0.08}, on_device);
    PairTable intersections(IntersectionTestQuery{}, on_device);
    PairTable contacts(ContactQuery{.tolerance = 0.08, .contact_distance = 0.1}, on_device);
    std::size_t read = 0;
    std::uint32_t rows = 0;
    expect_nothing_made(200, [&](int number) {
        bool ok = true;
        for (std::size_t i = 0; i < instances.size(); ++i) {
            // The same poses again and again, so that warming up has seen all.
            const double angle = 0.7 * (number % 8) + static_cast<double>(i);
            ok = world->move(instances[i], {{0.8 * static_cast<double>(i), 0.0}, angle}).ok() && ok;
        }
        ok = world->update(table).ok() && ok;
        for (const auto& row : table.rows()) {
            read += table.points(row).size();
        }
        rows = table.size();
        ok = world->update(intersections).ok() && ok;
        for (std::uint32_t row = 0; row < intersections.size(); ++row) {
            ok = intersections.row(row).has_value() && ok;
        }
        ok = world->submit(contacts).ok() && contacts.collect().ok() && ok;
        for (const auto& row : contacts.rows()) {
            read += contacts.points(row).size() + contacts.manifold(row).size();
        }
        return ok && table.read_status().ok() && contacts.read_status().ok();
    });
    EXPECT_GT(rows, 10U);
    EXPECT_GT(read, 1000U);
}

TEST_F(SteadyStateOfWorlds, QuestionsForTheDeviceAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<InstanceHandle> instances;
    for (std::size_t i = 0; i < 20; ++i) {
        // Some are at the same place, so that the CPU answers some questions.
        const Pose pose{{0.8 * static_cast<double>(i / 2), 0.0}, 0.0};
        const auto instance = world->add({.shape = shapes[0], .pose = pose});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        instances.push_back(*instance);
    }
    std::vector<Segment> segments;
    std::vector<Vector2> points;
    for (int i = 0; i < 300; ++i) {
        points.push_back({0.03 * i, 0.01 * (i % 50)});
        segments.push_back({{0.03 * i, -3.0}, {0.02 * i, 3.0}});
    }
    std::vector<RayHit> hits(segments.size());
    std::vector<NearestHit> near(points.size());
    const std::vector<Pose> poses(300, Pose{{3.6, 0.0}, 0.3});
    std::vector<std::uint8_t> meets(poses.size());
    const WorldOptions by_device{.technique = Technique::compute};
    WorldRequest rays;
    WorldRequest nearest;
    expect_nothing_made(200, [&](int number) {
        const double angle = 0.7 * (number % 8);
        // The last two move together.
        const bool ok = world->move(instances[18], {{7.2, 0.0}, angle}).ok() &&
                        world->move(instances[19], {{7.2, 0.0}, angle}).ok() &&
                        world->submit(nearest, {}, points, by_device).ok() &&
                        world->cast_rays(segments, hits, by_device).ok() &&
                        world->submit(rays, segments).ok() && nearest.collect(near).ok() &&
                        world->test_poses(shapes[1], poses, meets, by_device).ok() &&
                        rays.collect(hits).ok();
        return ok;
    });
    EXPECT_GT(nearest.left_to_cpu(), 10U);
    EXPECT_NE(hits[10].instance, InstanceHandle{});
}

TEST_F(SteadyStateOfWorlds, DevicePairsAtPosesOfTheHostAllocateAndCreateNothing) {
    Expected<World> world = World::create(watched());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    const std::vector<ShapeHandle> shapes = shapes_of_frame();
    std::vector<std::array<float, 4>> places;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto instance = world->add({.shape = shapes[i % 2], .pose = {}});
        ASSERT_TRUE(instance.has_value()) << instance.error().text();
        places.push_back({0.8F * static_cast<float>(i), 0.0F, 0.6F, 0.8F});
    }
    test_support::HostGpu gpu(host_device());
    const std::uint64_t bytes = sizeof(places[0]) * places.size();
    const auto buffer = gpu.make_buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    std::memcpy(const_cast<std::byte*>(buffer.data), places.data(), bytes);  // it is mapped
    DevicePoses poses;
    poses.buffer = buffer.buffer;
    poses.size = bytes;
    poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    PairTable<PenetrationQuery> table({.tolerance = 0.08, .on_device = true}, on_device);
    std::size_t read = 0;
    expect_nothing_made(200, [&](int) {
        bool ok =
            world->submit(table, at_poses(poses)).ok() && table.on_device() && table.collect().ok();
        for (const auto& row : table.rows()) {
            read += table.points(row).size();
        }
        return ok && table.read_status().ok();
    });
    EXPECT_GT(table.size(), 10U);
    EXPECT_GT(read, 1000U);
}

}  // namespace
}  // namespace nearfield::test
