#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/print.hpp>
#include <engine/graph/recorded_graph.hpp>

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/fixture.hpp>
#include <tests/unit/graph/support.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace nearfield::graph::testing {
namespace {

void VKAPI_CALL no_begin(VkCommandBuffer, const VkRenderPassBeginInfo*, VkSubpassContents) {}
void VKAPI_CALL no_end(VkCommandBuffer) {}
void VKAPI_CALL no_label(VkCommandBuffer, const VkDebugUtilsLabelEXT*) {}
void VKAPI_CALL no_timestamp(VkCommandBuffer, VkPipelineStageFlagBits, VkQueryPool, std::uint32_t) {
}

class GraphExecute : public test_support::GpuTest {
protected:
    /// The device, of which only barriers are recorded, by a function.
    [[nodiscard]] test_support::FakeLoader recording_by(PFN_vkCmdPipelineBarrier barrier) const {
        using test_support::erased;
        test_support::Lies lies;
        lies.entry_points = {{"vkCmdBeginRenderPass", erased(&no_begin)},
                             {"vkCmdEndRenderPass", erased(&no_end)},
                             {"vkCmdBeginDebugUtilsLabelEXT", erased(&no_label)},
                             {"vkCmdEndDebugUtilsLabelEXT", erased(&no_end)},
                             {"vkCmdWriteTimestamp", erased(&no_timestamp)},
                             {"vkCmdPipelineBarrier", erased(barrier)}};
        return {host_.device(), std::move(lies)};
    }
};

/// Buffers for all imported handles of a graph.
struct Buffers {
    std::vector<std::unique_ptr<gpu::MappedBuffer>> memory;
    std::vector<Imported> imported;
};
Buffers buffers_for(const gpu::Device& device, const Graph& graph) {
    Buffers buffers{{}, std::vector<Imported>(graph.resources().size())};
    for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
        if (graph.resources()[i].is_image) {
            continue;
        }
        buffers.memory.push_back(std::make_unique<gpu::MappedBuffer>(
            device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
            gpu::Direction::readback, graph.resources()[i].name()));
        buffers.memory.back()->reserve(256);
        buffers.imported[i].buffer = {buffers.memory.back()->handle()};
    }
    return buffers;
}

/// fill -> look, then cones -> look_again; the images of the two have the same memory class and
/// size.
struct TwoImages {
    Graph graph;
    Handle first = color(graph, "first", VK_FORMAT_R32_UINT, {64, 64});
    Handle second = color(graph, "second", VK_FORMAT_R8_UNORM, {64, 64});
    Handle distance = color(graph, "distance", VK_FORMAT_D32_SFLOAT, {64, 64});
    Handle records = graph.import_buffer({.name = "records", .read_by_host = true});

    TwoImages() {
        add_pass(graph, "fill", PassKind::graphics, {writes(first, Access::color_attachment)});
        add_pass(graph, "look", PassKind::compute,
                 {reads(next(first), Access::sampled_in_compute),
                  writes(records, Access::storage_write_in_compute)});
        add_pass(
            graph, "cones", PassKind::graphics,
            {reads(next(records), Access::vertex_buffer), writes(second, Access::color_attachment),
             writes(distance, Access::depth_stencil_attachment)});
        add_pass(graph, "look_again", PassKind::compute,
                 {reads(next(second), Access::sampled_in_compute),
                  reads(next(distance), Access::sampled_in_compute),
                  writes(next(records), Access::storage_write_in_compute)});
    }

    [[nodiscard]] BakedGraph baked() const { return *bake(graph); }
};

TEST_F(GraphExecute, RandomGraphsRunTwiceWithNothingToComplainOf) {
    const gpu::Device device(host_.device());
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed, device.stencil_format());
        const Graph& graph = random.graph();
        Executor executor(device, graph, *bake(graph));
        const Buffers buffers = buffers_for(device, graph);
        gpu::Submission submission(device);
        gpu::Timestamps timestamps(device, 2 * static_cast<std::uint32_t>(graph.passes().size()));
        VkCommandBuffer commands = submission.begin();
        timestamps.reset(commands);
        executor.execute(graph, buffers.imported, commands, timestamps, no_commands);
        executor.execute(graph, buffers.imported, commands, timestamps, no_commands);
        submission.submit();
        submission.wait();
        ASSERT_EQ(host_.messages(), std::vector<std::string>{})
            << print_text(graph, executor.baked());
    }
}

TEST_F(GraphExecute, PassesAreRecordedInOrderFromTheirInputAndTimedByName) {
    using Names = std::vector<std::string>;
    const gpu::Device device(host_.device());
    RecordedGraph<Names*> graph;
    const Handle sign = color(graph, "sign");
    graph.add_pass(
        "look", PassKind::compute,
        [&](PassBuilder& pass) { pass.read(next(sign), Access::sampled_in_compute); },
        [](VkCommandBuffer, Names* const& recorded) { recorded->emplace_back("look"); });
    graph.add_pass(
        "fill", PassKind::graphics,
        [&](PassBuilder& pass) {
            EXPECT_EQ(pass.write(sign, Access::color_attachment), next(sign));
        },
        [](VkCommandBuffer, Names* const& recorded) { recorded->emplace_back("fill"); });
    graph.compile(device);
    EXPECT_NE(graph.executor().sampled_view(sign), VkImageView{VK_NULL_HANDLE});
    gpu::Submission submission(device);
    gpu::Timestamps timestamps(device, 4);
    VkCommandBuffer commands = submission.begin();
    timestamps.reset(commands);
    Names recorded;
    Names again;
    const ComputeLayout layout(device, 16);
    const BoundResources resources = graph.make_resources(layout);
    graph.execute(commands, timestamps, resources, &recorded);
    graph.execute(commands, timestamps, resources, &again);
    submission.submit();
    submission.wait();
    EXPECT_EQ(recorded, again);
    EXPECT_EQ(recorded, (std::vector<std::string>{"fill", "look"}));
    std::vector<PassTime> times;
    timestamps.collect(times);
    ASSERT_EQ(times.size(), device.timestamp_bits() == 0 ? 0U : 2U);
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(times[i].name, recorded[i]);
    }
}

TEST_F(GraphExecute, ImagesThatShareASlotShareItsBytes) {
    const gpu::Device device(host_.device());
    const TwoImages two;
    const Executor shared(device, two.graph, two.baked());
    ASSERT_EQ(shared.baked().memory_slots, 2U);
    BakedGraph apart = two.baked();
    apart.lifetimes[two.second.resource].memory_slot = apart.memory_slots++;
    const Executor separate(device, two.graph, apart);
    EXPECT_GE(shared.image_bytes(), 2U * 4U * 64U * 64U);
    EXPECT_GE(separate.image_bytes(), shared.image_bytes() + 64U * 64U);
}

TEST_F(GraphExecute, BufferThatWasNotSetIsNamed) {
    const gpu::Device device(host_.device());
    const TwoImages two;
    Executor executor(device, two.graph, two.baked());
    gpu::Submission submission(device);
    gpu::Timestamps timestamps(device, 4);
    VkCommandBuffer commands = submission.begin();
    timestamps.reset(commands);
    try {
        executor.execute(two.graph, std::vector<Imported>(two.graph.resources().size()), commands,
                         timestamps, no_commands);
        FAIL() << "no Failure";
    } catch (const StatusException& failure) {
        EXPECT_NE(failure.status().message().find("'records'"), std::string::npos);
    }
}

std::uint32_t barrier_calls = 0;
std::uint32_t barriers_recorded = 0;
std::uint32_t memory_barriers_recorded = 0;

void VKAPI_CALL count_barriers(VkCommandBuffer, VkPipelineStageFlags, VkPipelineStageFlags,
                               VkDependencyFlags, std::uint32_t memory, const VkMemoryBarrier*,
                               std::uint32_t buffers, const VkBufferMemoryBarrier*,
                               std::uint32_t images, const VkImageMemoryBarrier*) {
    ++barrier_calls;
    memory_barriers_recorded += memory;
    barriers_recorded += buffers + images;
}

TEST_F(GraphExecute, OneBarrierCallAPassAndNoAllocation) {
    const test_support::FakeLoader loader = recording_by(&count_barriers);
    const gpu::Device device(loader.host());
    const TwoImages two;
    Executor executor(device, two.graph, two.baked());
    const Buffers buffers = buffers_for(device, two.graph);
    gpu::Timestamps timestamps(device, 4);
    std::size_t expected = executor.baked().to_host.size();
    for (const BakedPass& pass : executor.baked().passes) {
        expected += pass.barriers.size();
    }
    barrier_calls = 0;
    barriers_recorded = 0;
    memory_barriers_recorded = 0;
    const std::uint64_t before = test_support::allocation_count();
    executor.execute(two.graph, buffers.imported, VK_NULL_HANDLE, timestamps, no_commands);
    EXPECT_EQ(test_support::allocation_count(), before);
    EXPECT_EQ(barrier_calls, 5U);  // four passes and the host
    EXPECT_EQ(barriers_recorded, expected);
    EXPECT_EQ(memory_barriers_recorded, 0U);  // the slot's first image was read last
}

/// The last calls of vkCmdPipelineBarrier; they have room for all that a test makes.
struct RecordedCall {
    VkPipelineStageFlags source = 0;
    VkPipelineStageFlags destination = 0;
    std::array<VkImageMemoryBarrier, 2> images{};
    std::array<VkBufferMemoryBarrier, 2> buffers{};
};
std::array<RecordedCall, 4> recorded_calls;
std::size_t recorded_count = 0;

void VKAPI_CALL record_call(VkCommandBuffer, VkPipelineStageFlags source,
                            VkPipelineStageFlags destination, VkDependencyFlags, std::uint32_t,
                            const VkMemoryBarrier*, std::uint32_t buffers,
                            const VkBufferMemoryBarrier* buffer, std::uint32_t images,
                            const VkImageMemoryBarrier* image) {
    RecordedCall& call = recorded_calls[recorded_count++ % recorded_calls.size()];
    call = {source, destination, {}, {}};
    std::copy_n(image, images, call.images.begin());
    std::copy_n(buffer, buffers, call.buffers.begin());
}

template <class Object>
Object handle_of(std::uint64_t number) {
    return reinterpret_cast<Object>(number);
}

void expect_same(const RecordedCall& call, const RecordedCall& other) {
    EXPECT_EQ(call.source, other.source);
    EXPECT_EQ(call.destination, other.destination);
    const VkImageMemoryBarrier& image = call.images[0];
    EXPECT_EQ(image.image, other.images[0].image);
    EXPECT_EQ(image.oldLayout, other.images[0].oldLayout);
    EXPECT_EQ(image.newLayout, other.images[0].newLayout);
    EXPECT_EQ(image.srcAccessMask, other.images[0].srcAccessMask);
    EXPECT_EQ(image.dstAccessMask, other.images[0].dstAccessMask);
    EXPECT_EQ(image.subresourceRange.baseMipLevel, other.images[0].subresourceRange.baseMipLevel);
    EXPECT_EQ(image.subresourceRange.baseArrayLayer,
              other.images[0].subresourceRange.baseArrayLayer);
    EXPECT_EQ(call.buffers[0].offset, other.buffers[0].offset);
    EXPECT_EQ(call.buffers[0].size, other.buffers[0].size);
    EXPECT_EQ(call.buffers[0].srcAccessMask, other.buffers[0].srcAccessMask);
    EXPECT_EQ(call.buffers[0].dstAccessMask, other.buffers[0].dstAccessMask);
}

/// Barriers of a host's image that was copied to and is sampled next, and of a buffer without uses.
void expect_stated(const RecordedCall& first, const RecordedCall& last, const ImportedImage& image,
                   const ImportedBuffer& buffer) {
    EXPECT_EQ(first.source, VkPipelineStageFlags{VK_PIPELINE_STAGE_TRANSFER_BIT} |
                                VkPipelineStageFlags{VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT});
    EXPECT_EQ(first.images[0].image, image.image);
    EXPECT_EQ(first.images[0].srcAccessMask, VkAccessFlags{VK_ACCESS_TRANSFER_WRITE_BIT});
    EXPECT_EQ(first.images[0].oldLayout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(first.images[0].newLayout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(first.images[0].subresourceRange.baseMipLevel, image.level);
    EXPECT_EQ(first.images[0].subresourceRange.baseArrayLayer, image.layer);
    EXPECT_EQ(first.buffers[0].buffer, buffer.buffer);
    EXPECT_EQ(first.buffers[0].offset, buffer.offset);
    EXPECT_EQ(first.buffers[0].size, buffer.size);
    EXPECT_EQ(first.buffers[0].srcAccessMask, 0U);
    EXPECT_EQ(last.destination, VkPipelineStageFlags{VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT} |
                                    VkPipelineStageFlags{VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT});
    EXPECT_EQ(last.images[0].srcAccessMask, VkAccessFlags{VK_ACCESS_SHADER_WRITE_BIT});
    EXPECT_EQ(last.images[0].dstAccessMask, VkAccessFlags{VK_ACCESS_SHADER_READ_BIT});
    EXPECT_EQ(last.images[0].newLayout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(last.buffers[0].dstAccessMask, 0U);
}

// What the caller states belongs to one execution: the next one has the declared uses again.
TEST_F(GraphExecute, ExternalUsesTakeThePlaceOfTheDeclaredOnesForOneExecution) {
    const test_support::FakeLoader loader = recording_by(&record_call);
    const gpu::Device device(loader.host());
    Graph graph;
    const ExternalAccess image_access{Access::exported_image, Access::exported_image};
    const ExternalAccess buffer_access{Access::exported_buffer, Access::exported_buffer};
    const Handle image =
        graph.import_image({.name = "field", .format = VK_FORMAT_R32_SFLOAT}, image_access);
    const Handle buffer = graph.import_buffer({.name = "records"}, buffer_access);
    add_pass(graph, "export", PassKind::compute,
             {writes(image, Access::storage_image_in_compute),
              writes(buffer, Access::storage_write_in_compute)});
    Executor executor(device, graph, *bake(graph));
    gpu::Timestamps timestamps(device, 4);
    std::array<Imported, 2> imported;
    const auto execute = [&] {
        recorded_count = 0;
        executor.execute(graph, imported, VK_NULL_HANDLE, timestamps, no_commands);
        EXPECT_EQ(recorded_count, 2U);
    };

    const ImportedImage own_image{handle_of<VkImage>(1)};
    const ImportedBuffer own_buffer{handle_of<VkBuffer>(2)};
    imported[image.resource].image = own_image;
    imported[buffer.resource].buffer = own_buffer;
    execute();
    const std::array<RecordedCall, 4> declared = recorded_calls;
    EXPECT_EQ(declared[0].images[0].oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(declared[1].images[0].newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);

    ImportedImage hosts_image{handle_of<VkImage>(3), 2, 5};
    hosts_image.uses = ExternalUses{
        {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT,
         VK_IMAGE_LAYOUT_GENERAL},
        {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
         VK_IMAGE_LAYOUT_GENERAL}};
    ImportedBuffer hosts_buffer{handle_of<VkBuffer>(4), 256, 512};
    hosts_buffer.uses = ExternalUses{};  // nothing to wait for, and nothing that waits
    const std::uint64_t before = test_support::allocation_count();
    imported[image.resource].image = hosts_image;
    imported[buffer.resource].buffer = hosts_buffer;
    execute();
    EXPECT_EQ(test_support::allocation_count(), before);
    expect_stated(recorded_calls[0], recorded_calls[1], hosts_image, hosts_buffer);

    imported[image.resource].image = own_image;
    imported[buffer.resource].buffer = own_buffer;
    execute();
    expect_same(recorded_calls[0], declared[0]);
    expect_same(recorded_calls[1], declared[1]);
}

}  // namespace
}  // namespace nearfield::graph::testing
