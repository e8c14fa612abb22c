#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/query/all_numbers.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/techniques.hpp>
#include <tests/support/vulkan_host.hpp>

#include <cstdint>
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
                // nothing, so the test only requires of answers that they may change; between two
                // dispatches, and towards the host, the layer detects nothing.
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

}  // namespace
}  // namespace nearfield::test
