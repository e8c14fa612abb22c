#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/print.hpp>

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>
#include <tests/unit/gpu/fixture.hpp>
#include <tests/unit/graph/support.hpp>

#include <cstring>
#include <map>
#include <memory>

namespace nearfield::graph::testing {
namespace {

class GraphExecute : public test_support::GpuTest {};

/// Buffers for all imported handles of a graph.
std::vector<std::unique_ptr<gpu::MappedBuffer>> set_buffers(const gpu::Device& device,
                                                            const Graph& graph,
                                                            Executor& executor) {
    std::vector<std::unique_ptr<gpu::MappedBuffer>> buffers;
    for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
        if (graph.resources()[i].is_image) {
            continue;
        }
        buffers.push_back(std::make_unique<gpu::MappedBuffer>(
            device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
            gpu::Direction::readback, graph.resources()[i].name()));
        buffers.back()->reserve(256);
        executor.set_buffer({i, 0}, buffers.back()->handle());
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
        const auto buffers = set_buffers(device, graph, executor);
        gpu::Submission submission(device);
        gpu::Timestamps timestamps(device, 2 * static_cast<std::uint32_t>(graph.passes().size()));
        VkCommandBuffer commands = submission.begin();
        timestamps.reset(commands);
        executor.execute(graph, commands, timestamps);
        executor.execute(graph, commands, timestamps);
        submission.submit();
        submission.wait();
        ASSERT_EQ(host_.messages(), std::vector<std::string>{})
            << print_text(graph, executor.baked());
    }
}

TEST_F(GraphExecute, PassesAreRecordedInOrderAndTimedByName) {
    const gpu::Device device(host_.device());
    std::vector<std::string> recorded;
    Graph graph;
    const Handle sign = color(graph, "sign");
    graph.add_pass(
        "look", PassKind::compute,
        [&](PassBuilder& pass) { pass.read(next(sign), Access::sampled_in_compute); },
        [&](VkCommandBuffer) { recorded.emplace_back("look"); });
    graph.add_pass(
        "fill", PassKind::graphics,
        [&](PassBuilder& pass) {
            EXPECT_EQ(pass.write(sign, Access::color_attachment), next(sign));
        },
        [&](VkCommandBuffer) { recorded.emplace_back("fill"); });
    const Executor executor(device, graph, *bake(graph));
    EXPECT_NE(executor.sampled_view(sign), VkImageView{VK_NULL_HANDLE});
    gpu::Submission submission(device);
    gpu::Timestamps timestamps(device, 2);
    VkCommandBuffer commands = submission.begin();
    timestamps.reset(commands);
    executor.execute(graph, commands, timestamps);
    submission.submit();
    submission.wait();
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
    const Executor executor(device, two.graph, two.baked());
    gpu::Submission submission(device);
    gpu::Timestamps timestamps(device, 4);
    VkCommandBuffer commands = submission.begin();
    timestamps.reset(commands);
    try {
        executor.execute(two.graph, commands, timestamps);
        FAIL() << "no Failure";
    } catch (const StatusException& failure) {
        EXPECT_NE(failure.status().message().find("'records'"), std::string::npos);
    }
}

// Replacements for the driver's entry points by name; they carry no user data.
HostDevice truth;
std::map<std::string, PFN_vkVoidFunction> stand_ins;
int calls_until_failure = 0;

template <class Function>
Function true_function(const char* name) {
    const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        truth.get_instance_proc_addr(truth.instance, "vkGetDeviceProcAddr"));
    return reinterpret_cast<Function>(get(truth.device, name));
}

PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice, const char* name) {
    const auto found = stand_ins.find(name);
    return found != stand_ins.end() ? found->second : true_function<PFN_vkVoidFunction>(name);
}

PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
    }
    const auto found = stand_ins.find(name);
    return found != stand_ins.end() ? found->second : truth.get_instance_proc_addr(instance, name);
}

HostDevice with_stand_ins(const HostDevice& host,
                          std::map<std::string, PFN_vkVoidFunction> functions) {
    truth = host;
    stand_ins = std::move(functions);
    HostDevice changed = host;
    changed.get_instance_proc_addr = &instance_function;
    return changed;
}

VkResult VKAPI_CALL failing_allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                     const VkAllocationCallbacks* callbacks,
                                     VkDeviceMemory* memory) {
    if (--calls_until_failure < 0) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    return true_function<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, callbacks, memory);
}

VkResult VKAPI_CALL failing_framebuffer(VkDevice device, const VkFramebufferCreateInfo* info,
                                        const VkAllocationCallbacks* callbacks,
                                        VkFramebuffer* framebuffer) {
    if (--calls_until_failure < 0) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    return true_function<PFN_vkCreateFramebuffer>("vkCreateFramebuffer")(device, info, callbacks,
                                                                         framebuffer);
}

/// The fixture checks that nothing is leaked.
TEST_F(GraphExecute, RunningOutOfMemoryOnTheWayIsSaidAndLeaksNothing) {
    const TwoImages two;
    const std::map<std::string, PFN_vkVoidFunction> failing = {
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(&failing_allocate)},
        {"vkCreateFramebuffer", reinterpret_cast<PFN_vkVoidFunction>(&failing_framebuffer)}};
    for (const auto& entry : failing) {
        const gpu::Device device(with_stand_ins(host_.device(), {entry}));
        // Both images lie in one block of memory.
        const bool is_memory = entry.first == "vkAllocateMemory";
        for (int successes = 0; successes < (is_memory ? 1 : 2); ++successes) {
            calls_until_failure = successes;
            try {
                const Executor executor(device, two.graph, two.baked());
                FAIL() << "no Failure";
            } catch (const StatusException& failure) {
                EXPECT_EQ(failure.status().code(), StatusCode::out_of_memory);
                EXPECT_NE(failure.status().message().find(entry.first), std::string::npos);
            }
        }
    }
}

void VKAPI_CALL no_begin(VkCommandBuffer, const VkRenderPassBeginInfo*, VkSubpassContents) {}
void VKAPI_CALL no_end(VkCommandBuffer) {}
void VKAPI_CALL no_label(VkCommandBuffer, const VkDebugUtilsLabelEXT*) {}
void VKAPI_CALL no_timestamp(VkCommandBuffer, VkPipelineStageFlagBits, VkQueryPool, std::uint32_t) {
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
    const gpu::Device device(with_stand_ins(
        host_.device(),
        {{"vkCmdBeginRenderPass", reinterpret_cast<PFN_vkVoidFunction>(&no_begin)},
         {"vkCmdEndRenderPass", reinterpret_cast<PFN_vkVoidFunction>(&no_end)},
         {"vkCmdBeginDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(&no_label)},
         {"vkCmdEndDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(&no_end)},
         {"vkCmdWriteTimestamp", reinterpret_cast<PFN_vkVoidFunction>(&no_timestamp)},
         {"vkCmdPipelineBarrier", reinterpret_cast<PFN_vkVoidFunction>(&count_barriers)}}));
    const TwoImages two;
    Executor executor(device, two.graph, two.baked());
    const auto buffers = set_buffers(device, two.graph, executor);
    gpu::Timestamps timestamps(device, 4);
    std::size_t expected = executor.baked().to_host.size();
    for (const BakedPass& pass : executor.baked().passes) {
        expected += pass.barriers.size();
    }
    barrier_calls = 0;
    barriers_recorded = 0;
    memory_barriers_recorded = 0;
    const std::uint64_t before = test_support::allocation_count();
    executor.execute(two.graph, VK_NULL_HANDLE, timestamps);
    EXPECT_EQ(test_support::allocation_count(), before);
    EXPECT_EQ(barrier_calls, 5U);  // four passes and the host
    EXPECT_EQ(barriers_recorded, expected);
    EXPECT_EQ(memory_barriers_recorded, 0U);  // the slot's first image was read last
}

}  // namespace
}  // namespace nearfield::graph::testing
