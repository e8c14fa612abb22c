#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/buffer_hazards.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/pair_tables.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::BufferAccesses;
using test_support::Dependency;
using test_support::find_hazards;

/// Every barrier between accesses to buffers, those of the render graph and those beside it.
class Hazards : public testing::Test {
protected:
    void SetUp() override { start(BufferAccesses::lies()); }
    void start(test_support::Lies lies) {
        loader_.emplace(host_.device(), std::move(lies));
        Settings settings;
        settings.batches_in_flight = 1;
        Expected<Context> made = Context::create(loader_->host(), on_demand(settings));
        ASSERT_TRUE(made.has_value()) << made.error().text();
        context_.emplace(std::move(*made));
        Random random(23000);
        a_ = *context_->add_shape(coast(random, 100, 0.5));
        b_ = *context_->add_shape(with_holes(random, 3));
    }
    void TearDown() override {
        context_.reset();
        loader_.reset();
        EXPECT_EQ(host_.close(), std::vector<std::string>{});
    }

    /// Another context, whose shaders reach less of a buffer.
    void start_anew(std::uint32_t reach) {
        context_.reset();
        loader_.reset();
        test_support::Lies lies = BufferAccesses::lies();
        lies.properties = [reach](VkPhysicalDeviceProperties& properties) {
            properties.limits.maxStorageBufferRange = reach;
        };
        start(std::move(lies));
    }

    /// With an intersection whose tile is large enough for an occlusion query.
    [[nodiscard]] Batch every() const {
        Batch batch = every_query(a_, b_, 0);
        IntersectionQuery watched{{a_, {}}, {b_, {{0.7, 0.0}, 0.3}}, 0.005};
        watched.technique = Technique::raster;
        watched.summary_only = true;
        batch.add(watched);
        return batch;
    }

    void run(const Batch& batch) {
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
    }

    void record(const Batch& batch) {
        test_support::HostFrames frames(host_.device(), 1);
        const Expected<Ticket> ticket =
            context_->record(batch, {.commands = frames.begin(0), .frame = 0});
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        frames.submit(0);
        frames.wait(0);
        context_->frame_completed(0);
        Results results;
        const Status status = context_->collect(*ticket, results);
        EXPECT_TRUE(status.ok()) << status.text();
    }

    /// Alone, so that no barrier of another query covers what it needs.
    void run_alone(const AnyQuery& query) {
        Batch batch;
        std::visit([&](const auto& one) { batch.add(one); }, query);
        run(batch);
    }

    /// Pairs found by the device. Several workgroups have the boxes of more than 64 instances.
    template <class Query>
    void update_device_pairs(int count, const Query& query) {
        Expected<World> world = World::create(*context_);
        ASSERT_TRUE(world.has_value()) << world.error().text();
        for (int i = 0; i < count; ++i) {
            const WorldInstance instance{.shape = i % 2 == 0 ? a_ : b_,
                                         .pose = {{0.5 * i, 0.0}, 0.1 * i}};
            ASSERT_TRUE(world->add(instance).has_value());
        }
        PairTable<Query> table(query, on_device);
        const Status status = world->update(table);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_GT(table.size(), 0U);
    }

    /// Rays, points and poses that the device is asked about, some of them twice in the same
    /// memory.
    void ask_device(int count) {
        Expected<World> world = World::create(*context_);
        ASSERT_TRUE(world.has_value()) << world.error().text();
        for (int i = 0; i < count; ++i) {
            const WorldInstance instance{.shape = i % 2 == 0 ? a_ : b_,
                                         .pose = {{0.5 * i, 0.0}, 0.1 * i}};
            ASSERT_TRUE(world->add(instance).has_value());
        }
        const WorldOptions by_device{.technique = Technique::compute};
        const std::vector<Segment> segments(100, Segment{{-5.0, 0.1}, {50.0, 0.2}});
        const std::vector<Vector2> points(100, Vector2{1.0, 0.1});
        std::vector<RayHit> hits(segments.size());
        std::vector<NearestHit> near(points.size());
        for (int i = 0; i < 2; ++i) {
            EXPECT_TRUE(world->cast_rays(segments, hits, by_device).ok());
            EXPECT_TRUE(world->find_nearest({}, points, near, by_device).ok());
        }
        EXPECT_NE(hits.front().instance, InstanceHandle{});
        const std::vector<Pose> poses(100, Pose{{1.0, 0.1}, 0.2});
        std::vector<std::uint8_t> meets(poses.size());
        EXPECT_TRUE(world->test_poses(b_, poses, meets, by_device).ok());
        EXPECT_EQ(meets.front(), 1);
    }

    /// The same at poses in a buffer of the host's, with results that stay on the device.
    template <class Query>
    void leave_device_pairs(const Query& query) {
        constexpr std::size_t count = 100;
        test_support::HostGpu gpu(host_.device());
        const auto buffer = gpu.make_buffer(16 * count, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        Expected<World> world = World::create(*context_);
        ASSERT_TRUE(world.has_value()) << world.error().text();
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_TRUE(world->add({.shape = i % 2 == 0 ? a_ : b_}).has_value());
            const std::array<float, 4> pose{0.5F * static_cast<float>(i), 0.0F, 0.6F, 0.8F};
            std::memcpy(const_cast<std::byte*>(buffer.data) + 16 * i, pose.data(), 16);
        }
        DevicePoses poses;
        poses.buffer = buffer.buffer;
        poses.size = 16 * count;
        poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        poses.before = {};  // the host has written it, before the submission
        PairTable<Query> table(query, on_device);
        const Status status = world->update(table, at_poses(poses));
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_GT(table.size(), 0U);
    }

    /// What was recorded has no hazard, and would have one without any of its dependencies.
    /// `in_parts`: pairs are searched in several parts.
    static void check(bool in_parts = false) {
        const auto recordings = BufferAccesses::recordings();
        EXPECT_EQ(find_hazards(recordings), std::vector<std::string>{});
        int checked = 0;
        const std::vector<Dependency> all = test_support::dependencies(recordings);
        for (const Dependency& dependency : all) {
            const std::string buffer = BufferAccesses::name_of(dependency.buffer);
            if (buffer == "nearfield resident words" &&
                dependency.destination == VK_ACCESS_HOST_READ_BIT) {
                continue;  // the same graph serves results that the host reads
            }
            if (buffer.empty() && dependency.buffer != VK_NULL_HANDLE) {
                continue;  // the host's, and what it did before is not seen
            }
            if (buffer == "nearfield resident pair records" && dependency.source == 0) {
                continue;  // the wait before the pairs is one for all that follows
            }
            if (!in_parts && buffer == "nearfield pair arguments" && dependency.source == 0) {
                continue;  // a part waits for the dispatches of the one before
            }
            // Two resources of a graph can stand in one buffer, whose barriers cover both.
            const bool is_covered = std::any_of(all.begin(), all.end(), [&](const auto& other) {
                return other != dependency && other.buffer == dependency.buffer &&
                       other.source == dependency.source && dependency.source != 0 &&
                       (other.destination & dependency.destination) == dependency.destination;
            });
            if (is_covered) {
                continue;
            }
            EXPECT_NE(find_hazards(recordings, &dependency), std::vector<std::string>{})
                << "needless: access " << dependency.source << " to " << dependency.destination
                << " of " << (buffer.empty() ? "all buffers" : buffer);
            ++checked;
        }
        EXPECT_GT(checked, 5);
    }

private:
    test_support::VulkanHost host_;
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> context_;
    ShapeHandle a_;
    ShapeHandle b_;
};

TEST_F(Hazards, AreInNoBatch) {
    run(every());
    check();
}

TEST_F(Hazards, AreInNoBatchWhoseResultsStay) {
    run(resident_queries(every()));
    check();
}

TEST_F(Hazards, AreInNoQueryThatIsAlone) {
    const Batch all = every();
    const Batch whose_results_stay = resident_queries(all);
    for (const Batch* const batch : {&all, &whose_results_stay}) {
        for (const AnyQuery& query : batch->queries()) {
            run_alone(query);
        }
    }
    EXPECT_EQ(find_hazards(BufferAccesses::recordings()), std::vector<std::string>{});
}

TEST_F(Hazards, AreInNoUpdateOfDevicePairs) {
    constexpr PenetrationQuery without_records{.tolerance = 0.05, .summary_only = true};
    for (const int count : {3, 100}) {
        update_device_pairs(count, without_records);
    }
    EXPECT_EQ(find_hazards(BufferAccesses::recordings()), std::vector<std::string>{});
    for (const int count : {3, 100}) {
        update_device_pairs(count, PenetrationQuery{.tolerance = 0.05});
        update_device_pairs(count, ContactQuery{.tolerance = 0.05, .contact_distance = 0.05});
        update_device_pairs(count, IntersectionTestQuery{});
    }
    check();
}

/// All parts use the same memory.
TEST_F(Hazards, AreInNoPartsOfDevicePairs) {
    constexpr PenetrationPoints vertices = PenetrationPoints::vertices;
    start_anew(1U << 18U);
    update_device_pairs(100, PenetrationQuery{.tolerance = 0.2});
    update_device_pairs(100, ContactQuery{.tolerance = 0.2, .contact_distance = 0.05});
    update_device_pairs(100, IntersectionTestQuery{});
    check(true);
    start_anew(1U << 20U);
    leave_device_pairs(PenetrationQuery{
        .tolerance = 0.2, .points = vertices, .summary_only = true, .on_device = true});
    leave_device_pairs(PenetrationQuery{.tolerance = 0.2, .points = vertices, .on_device = true});
    EXPECT_EQ(find_hazards(BufferAccesses::recordings()), std::vector<std::string>{});
}

TEST_F(Hazards, AreInNoQuestionsAboutAWorld) {
    ask_device(3);
    ask_device(100);
    check();
}

TEST_F(Hazards, AreInNoDevicePairsThatStayOnTheDevice) {
    leave_device_pairs(
        PenetrationQuery{.tolerance = 0.05, .summary_only = true, .on_device = true});
    EXPECT_EQ(find_hazards(BufferAccesses::recordings()), std::vector<std::string>{});
    leave_device_pairs(
        ContactQuery{.tolerance = 0.05, .contact_distance = 0.05, .on_device = true});
    check();
}

TEST_F(Hazards, AreInNoFrameOfAHost) {
    record(every());
    check();
}

}  // namespace
}  // namespace nearfield::test
