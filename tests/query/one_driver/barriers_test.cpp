#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/query/all_numbers.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/pair_tables.hpp>
#include <tests/support/techniques.hpp>
#include <tests/support/vulkan_host.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

// Omits one barrier of a frame and checks the effect on the answers. A model of memory proves the
// waits necessary (tests/unit/graph/bake.cpp); this test shows that the model matches reality: the
// device or the validation layer detects the omission too.

constexpr std::uint32_t none = UINT32_MAX;
std::uint32_t left_out = none;
std::uint32_t barriers = 0;
bool to_the_host = false;  // the omitted one
bool of_images = false;

void VKAPI_CALL max_barriers(VkCommandBuffer commands, VkPipelineStageFlags source,
                             VkPipelineStageFlags destination, VkDependencyFlags flags,
                             std::uint32_t memory_count, const VkMemoryBarrier* memory,
                             std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                             std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    static const auto record = reinterpret_cast<PFN_vkCmdPipelineBarrier>(
        test_support::true_device_function("vkCmdPipelineBarrier"));
    if (barriers++ == left_out) {
        to_the_host = (destination & VK_PIPELINE_STAGE_HOST_BIT) != 0;
        of_images = image_count > 0;
        return;
    }
    record(commands, source, destination, flags, memory_count, memory, buffer_count, buffers,
           image_count, images);
}

const std::vector<Vector2> ring_a{{0, 0}, {3, 0}, {3, 2}, {2, 1}, {1, 2}, {0, 2}};
const std::vector<Vector2> ring_b{{0, 0}, {2, 0.2}, {2.5, 1.5}, {1, 2.5}, {-0.5, 1}};

/// Runs a frame in a new context; returns its answers as numbers.
std::vector<double> frame(const HostDevice& host, Technique technique) {
    Settings settings;
    settings.pipelines_on_demand = true;
    Expected<Context> context = Context::create(host, settings);
    EXPECT_TRUE(context.has_value()) << context.error().text();
    const Expected<ShapeHandle> a = context->add_shape({{ring_a}});
    const Expected<ShapeHandle> b = context->add_shape({{ring_b}});
    EXPECT_TRUE(a.has_value() && b.has_value());
    const Instance here{*a, {}};
    const Instance there{*b, {{1.2, 0.4}, 0.3}};
    Batch batch;
    batch.add(PenetrationQuery{here, there, 0.02, {}, false, technique});
    batch.add(IntersectionQuery{here, there, 0.02, IntersectionKind::volume_volume, false,
                                IntersectionStrategy::blend, technique});
    DistanceFieldQuery field{here, there, 0.02};
    field.features = true;
    field.technique = technique;
    batch.add(field);
    Results results;
    barriers = 0;
    const Status status = context->run(batch, results);
    // A device that works in parallel may count anything.
    EXPECT_TRUE(status.ok() || (left_out != none && status.code() == StatusCode::device_error))
        << status.text();
    return all_numbers(results);
}

TEST(Barriers, ThatAreLeftOutAreMissed) {
    test_support::VulkanHost host;
    {
        test_support::Lies lies;
        lies.entry_points["vkCmdPipelineBarrier"] =
            reinterpret_cast<PFN_vkVoidFunction>(&max_barriers);
        const test_support::FakeLoader loader(host.device(), lies);
        for (const Technique technique : device_techniques) {
            SCOPED_TRACE(to_string(technique));
            left_out = none;
            const std::vector<double> expected = frame(loader.host(), technique);
            const std::uint32_t count = barriers;
            EXPECT_GT(count, 3U);
            EXPECT_EQ(host.messages(), std::vector<std::string>{});
            std::uint32_t noticed = 0;
            std::uint32_t towards_host = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                left_out = i;
                const bool corrupted = frame(loader.host(), technique) != expected;
                const bool complained = !host.messages().empty();
                // A wrong layout is always detected. A processor that works sequentially corrupts
                // nothing, so the test only requires of answers that they may change; towards the
                // host the layer detects nothing, and between two dispatches only a newer one does.
                EXPECT_TRUE(complained || corrupted || !of_images) << "barrier " << i;
                noticed += complained || corrupted ? 1U : 0U;
                towards_host += to_the_host ? 1U : 0U;
                host.clear_messages();
            }
            EXPECT_GT(noticed, count / 3);
            // By compute, the search for points is a graph of its own; drawn, the field and the
            // intersection have tile batches of their own.
            EXPECT_EQ(towards_host, 2U);
        }
        left_out = none;
    }
    EXPECT_EQ(host.close(), std::vector<std::string>{});
}

/// Records a table of pairs at poses of the host's, again and again without one of its barriers,
/// and executes it twice in one submission. Returns for how many barriers the layer is silent.
template <class Query>
std::uint32_t count_missed_by_layer(const Query& query) {
    test_support::VulkanHost host;
    std::uint32_t missed = 0;
    {
        test_support::Lies lies;
        lies.entry_points["vkCmdPipelineBarrier"] =
            reinterpret_cast<PFN_vkVoidFunction>(&max_barriers);
        const test_support::FakeLoader loader(host.device(), lies);
        Settings settings;
        settings.pipelines_on_demand = true;
        Expected<Context> context = Context::create(loader.host(), settings);
        EXPECT_TRUE(context.has_value()) << context.error().text();
        const ShapeHandle a = *context->add_shape({{ring_a}});
        const ShapeHandle b = *context->add_shape({{ring_b}});
        Expected<World> world = World::create(*context);
        EXPECT_TRUE(world.has_value()) << world.error().text();
        constexpr std::size_t count = 100;
        test_support::HostGpu gpu(loader.host());
        const auto buffer = gpu.make_buffer(16 * count, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_TRUE(world->add({.shape = i % 2 == 0 ? a : b}).has_value());
            const std::array<float, 4> pose{0.5F * static_cast<float>(i), 0.0F, 0.6F, 0.8F};
            std::memcpy(const_cast<std::byte*>(buffer.data) + 16 * i, pose.data(), 16);
        }
        DevicePoses poses;
        poses.buffer = buffer.buffer;
        poses.size = 16 * count;
        poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        poses.before = {};  // the host has written it, before the submission
        PairTable<Query> table(query, on_device);
        left_out = none;
        EXPECT_TRUE(world->update(table, at_poses(poses)).ok());
        std::uint64_t frame = 0;
        const auto execute = [&](std::uint32_t omitted) {
            test_support::KeptCommands kept(loader.host());
            const VkCommandBuffer commands = kept.begin();
            barriers = 0;
            left_out = omitted;
            const Status status =
                world->record(table, {.commands = commands, .frame = ++frame}, at_poses(poses));
            left_out = none;
            EXPECT_TRUE(status.ok()) << status.text();
            kept.end(commands);
            kept.run(std::array{commands, commands});
            context->frame_completed(frame);
            static_cast<void>(table.collect());  // of counts that may be anything
            return barriers;
        };
        const std::uint32_t all = execute(none);
        EXPECT_GT(all, 10U);
        EXPECT_EQ(host.messages(), std::vector<std::string>{});
        for (std::uint32_t i = 0; i < all; ++i) {
            execute(i);
            missed += host.messages().empty() ? 1U : 0U;
            host.clear_messages();
        }
    }
    EXPECT_EQ(host.close(), std::vector<std::string>{});
    return missed;
}

TEST(Barriers, OfARecordedTableAreMissed) {
    if (std::getenv("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC") == nullptr) {
        GTEST_SKIP() << "the validation layer does not see what dispatches access";
    }
    // The layer does not see what the host reads.
    EXPECT_EQ(count_missed_by_layer(IntersectionTestQuery{}), 1U);
    // The scratch memory waits for the search before, as it does above; where results stay, so do
    // the host's shaders, which wait for all that reads and writes it.
    EXPECT_EQ(count_missed_by_layer(
                  ContactQuery{.tolerance = 0.05, .contact_distance = 0.05, .on_device = true}),
              2U);
}

}  // namespace
}  // namespace nearfield::test
