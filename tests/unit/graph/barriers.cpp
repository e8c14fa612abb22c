#include <engine/gpu/buffer.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/print.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/support/mock_driver.hpp>
#include <tests/unit/graph/simulation.hpp>
#include <tests/unit/graph/support.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

// No barrier is needless, every kind of wait has been tested, and the commands sent to the driver
// equal the baked waits.

namespace nearfield::graph::testing {
namespace {

constexpr unsigned graph_count = 300;

/// The lists of barriers of a baked graph: before each pass, and towards the host.
std::vector<std::vector<Barrier>*> lists_of(BakedGraph& baked) {
    std::vector<std::vector<Barrier>*> lists;
    for (BakedPass& pass : baked.passes) {
        lists.push_back(&pass.barriers);
    }
    lists.push_back(&baked.to_host);
    return lists;
}

/// Calls `look(graph, original, mutated)` for each barrier of random graphs, with it removed.
template <class Look>
void for_each_removal(const Look& look) {
    for (unsigned seed = 0; seed < graph_count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed);
        const BakedGraph original = *bake(random.graph());
        BakedGraph baked = original;
        for (std::vector<Barrier>* const list : lists_of(baked)) {
            for (std::size_t i = 0; i < list->size(); ++i) {
                const Barrier removed = (*list)[i];
                const auto place = list->begin() + static_cast<std::ptrdiff_t>(i);
                list->erase(place);
                look(random.graph(), original, baked);
                if (::testing::Test::HasFailure()) {
                    return;
                }
                list->insert(list->begin() + static_cast<std::ptrdiff_t>(i), removed);
            }
        }
    }
}

TEST(GraphBarriers, OfEveryKindAreMissedAndNoneIsRedundant) {
    const std::vector<std::string> kinds{
        "read after write",
        "write after read",
        "write after write",
        "finds another layout",
        "finds another image in the memory",
        "the host does not see a write",
    };
    std::map<std::string, std::size_t> missed;
    std::size_t redundant = 0;
    for_each_removal([&](const Graph& graph, const BakedGraph& original, const BakedGraph& baked) {
        const std::string breach = simulate(graph, baked);
        redundant += breach.empty() ? 1U : 0U;
        ASSERT_NE(breach, "") << print_text(graph, original);
        const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const std::string& name) {
            return breach.find(name) != std::string::npos;
        });
        ++missed[kind != kinds.end() ? *kind : breach];
    });
    EXPECT_EQ(redundant, 0U);
    for (const std::string& kind : kinds) {
        EXPECT_GT(missed[kind], 20U) << kind;
    }
}

/// Removing the access masks keeps the execution order and loses the visibility of writes.
TEST(GraphBarriers, ThatOnlyOrderExecutionDoNotMakeWritesVisible) {
    std::size_t missed = 0;
    std::size_t missed_by_host = 0;
    for (unsigned seed = 0; seed < graph_count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed);
        BakedGraph baked = *bake(random.graph());
        for (std::vector<Barrier>* const list : lists_of(baked)) {
            for (Barrier& barrier : *list) {
                const Barrier whole = barrier;
                barrier.source_access = 0;
                barrier.destination_access = 0;
                // A write after reads needs only the order: there is nothing to make visible.
                if (whole.source_access != 0 && whole.old_layout == whole.new_layout) {
                    ASSERT_NE(simulate(random.graph(), baked), "")
                        << print_text(random.graph(), baked);
                    ++(list == &baked.to_host ? missed_by_host : missed);
                }
                barrier = whole;
            }
        }
    }
    EXPECT_GT(missed, 20U);
    EXPECT_GT(missed_by_host, 20U);
}

// The commands sent to the driver.

struct Call {
    VkPipelineStageFlags source = 0;
    VkPipelineStageFlags destination = 0;
    std::vector<VkMemoryBarrier> memory;
    std::vector<VkBufferMemoryBarrier> buffers;
    std::vector<VkImageMemoryBarrier> images;
};
std::vector<Call> calls;

void VKAPI_CALL note_barriers(VkCommandBuffer, VkPipelineStageFlags source,
                              VkPipelineStageFlags destination, VkDependencyFlags,
                              std::uint32_t memory_count, const VkMemoryBarrier* memory,
                              std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                              std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    calls.push_back({source,
                     destination,
                     {memory, memory + memory_count},
                     {buffers, buffers + buffer_count},
                     {images, images + image_count}});
}

bool same_access(const Barrier& baked, VkAccessFlags source, VkAccessFlags destination) {
    return baked.source_access == source && baked.destination_access == destination;
}

/// The call must match the barriers, for the right buffers; its stages are the union of theirs.
void expect_same(const Graph& graph, const std::vector<Barrier>& barriers, const Call& call,
                 const std::map<std::uint32_t, VkBuffer>& buffers) {
    VkPipelineStageFlags source = 0;
    VkPipelineStageFlags destination = 0;
    std::size_t on_memory = 0;
    std::size_t on_images = 0;
    std::size_t on_buffers = 0;
    for (const Barrier& barrier : barriers) {
        source |= barrier.source_stages;
        destination |= barrier.destination_stages;
        if (barrier.takes_over_memory) {
            ASSERT_LT(on_memory, call.memory.size());
            const VkMemoryBarrier& memory = call.memory[on_memory++];
            EXPECT_TRUE(same_access(barrier, memory.srcAccessMask, memory.dstAccessMask));
        }
        if (graph.resources()[barrier.resource].is_image) {
            ASSERT_LT(on_images, call.images.size());
            const VkImageMemoryBarrier& image = call.images[on_images++];
            EXPECT_TRUE(same_access(barrier, image.srcAccessMask, image.dstAccessMask));
            EXPECT_EQ(image.oldLayout, barrier.old_layout);
            EXPECT_EQ(image.newLayout, barrier.new_layout);
        } else {
            ASSERT_LT(on_buffers, call.buffers.size());
            const VkBufferMemoryBarrier& buffer = call.buffers[on_buffers++];
            EXPECT_TRUE(same_access(barrier, buffer.srcAccessMask, buffer.dstAccessMask));
            EXPECT_EQ(buffer.buffer, buffers.at(barrier.resource));
            EXPECT_EQ(buffer.offset, 0U);
            EXPECT_EQ(buffer.size, VK_WHOLE_SIZE);
        }
    }
    EXPECT_EQ(call.source, source);
    EXPECT_EQ(call.destination, destination);
    EXPECT_EQ(on_memory, call.memory.size());
    EXPECT_EQ(on_images, call.images.size());
    EXPECT_EQ(on_buffers, call.buffers.size());
}

TEST(GraphBarriers, ThatWereBakedAreThoseRecorded) {
    const test_support::MockDriver driver;
    test_support::Lies lies;
    lies.entry_points["vkCmdPipelineBarrier"] =
        reinterpret_cast<PFN_vkVoidFunction>(&note_barriers);
    const test_support::FakeLoader loader(driver.host(), lies);
    const gpu::Device device(loader.host());
    std::size_t compared = 0;
    for (unsigned seed = 0; seed < graph_count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed, device.stencil_format());
        const Graph& graph = random.graph();
        Executor executor(device, graph, *bake(graph));
        std::vector<std::unique_ptr<gpu::MappedBuffer>> memory;
        std::map<std::uint32_t, VkBuffer> buffers;
        std::vector<Imported> imported(graph.resources().size());
        for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
            if (!graph.resources()[i].is_image) {
                memory.push_back(std::make_unique<gpu::MappedBuffer>(
                    device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::none, "buffer"));
                memory.back()->reserve(16);
                buffers[i] = memory.back()->handle();
                imported[i].buffer = {buffers[i]};
            }
        }
        gpu::Submission submission(device);
        gpu::Timestamps timestamps(device, static_cast<std::uint32_t>(graph.passes().size()));
        calls.clear();
        VkCommandBuffer commands = submission.begin();
        timestamps.reset(commands);
        executor.execute(graph, imported, commands, timestamps, no_commands);
        BakedGraph baked = executor.baked();
        std::size_t next = 0;
        for (const std::vector<Barrier>* const list : lists_of(baked)) {
            if (!list->empty()) {
                ASSERT_LT(next, calls.size());
                expect_same(graph, *list, calls[next++], buffers);
                ++compared;
            }
        }
        EXPECT_EQ(next, calls.size());
    }
    EXPECT_GT(compared, graph_count);
    EXPECT_EQ(driver.breaches(), std::vector<std::string>{});
    EXPECT_EQ(driver.alive(), std::vector<std::string>{});
}

}  // namespace
}  // namespace nearfield::graph::testing
