#include <tests/query/every_query.hpp>
#include <tests/query/host_table.hpp>
#include <tests/support/host_gpu.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::WatchedCall;

/// A host's allocation callbacks, which count allocations and frees.
struct CountingAllocator {
    std::atomic<std::int64_t> in_use{0};
    std::atomic<std::int64_t> given{0};
    std::mutex mutex;
    std::map<void*, std::size_t> sizes;

    [[nodiscard]] VkAllocationCallbacks callbacks() {
        VkAllocationCallbacks result{};
        result.pUserData = this;
        result.pfnAllocation = [](void* user, std::size_t size, std::size_t alignment,
                                  VkSystemAllocationScope) {
            return static_cast<CountingAllocator*>(user)->take(size, alignment);
        };
        result.pfnReallocation = [](void* user, void* original, std::size_t size,
                                    std::size_t alignment, VkSystemAllocationScope) {
            auto& self = *static_cast<CountingAllocator*>(user);
            if (size == 0) {
                self.give_back(original);
                return static_cast<void*>(nullptr);
            }
            void* const memory = self.take(size, alignment);
            if (original != nullptr && memory != nullptr) {
                std::memcpy(memory, original, std::min(size, self.size_of(original)));
                self.give_back(original);
            }
            return memory;
        };
        result.pfnFree = [](void* user, void* memory) {
            static_cast<CountingAllocator*>(user)->give_back(memory);
        };
        return result;
    }

private:
    void* take(std::size_t size, std::size_t alignment) {
        alignment = std::max(alignment, sizeof(void*));
        void* const memory =
            std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        const std::lock_guard lock(mutex);
        sizes[memory] = size;
        ++in_use;
        ++given;
        return memory;
    }
    std::size_t size_of(void* memory) {
        const std::lock_guard lock(mutex);
        return sizes[memory];
    }
    void give_back(void* memory) {
        if (memory == nullptr) {
            return;
        }
        {
            const std::lock_guard lock(mutex);
            sizes.erase(memory);
            --in_use;
        }
        std::free(memory);
    }
};

/// Of device memory that is allocated in too small or too many pieces.
constexpr std::array about_allocations{"small-allocation", "small-dedicated-allocation",
                                       "too-many-objects"};
/// Of push constants that a pipeline has and nobody sets.
constexpr std::array about_push_constants{"BestPractices-PushConstants"};

/// The messages of these rules.
std::vector<std::string> messages_of(std::span<const char* const> rules,
                                     const std::vector<std::string>& messages) {
    std::vector<std::string> found;
    std::copy_if(messages.begin(), messages.end(), std::back_inserter(found),
                 [rules](const std::string& message) {
                     return std::any_of(rules.begin(), rules.end(), [&](const char* rule) {
                         return message.find(rule) != std::string::npos;
                     });
                 });
    return found;
}

/// A host under the layer's best practices that allocates as little as `size` for a buffer.
std::vector<std::string> messages_about(VkDeviceSize size) {
    test_support::Enabled enabled;
    enabled.best_practices = true;
    test_support::VulkanHost strict(enabled);
    {
        test_support::HostGpu gpu(strict.device());
        static_cast<void>(gpu.make_buffer(size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
    }
    return messages_of(about_allocations, strict.close());
}

TEST_F(HostTable, SmallAllocationsAreNoticed) {
    make_host();
    EXPECT_EQ(messages_about(1U << 21U), std::vector<std::string>{});
    EXPECT_NE(messages_about(1U << 16U), std::vector<std::string>{});
}

TEST_F(HostTable, MemoryIsTakenFromFewBlocksAndPushConstantsAreSet) {
    make_host();
    std::set<std::uint64_t> blocks;
    std::size_t most = 0;
    test_support::Enabled enabled;
    enabled.best_practices = true;
    test_support::VulkanHost strict(enabled);
    {
        const test_support::FakeLoader loader(
            strict.device(), test_support::watched(strict.device(), [&](const WatchedCall& call) {
                if (call.name == "vkAllocateMemory") {
                    blocks.insert(call.made);
                    most = std::max(most, blocks.size());
                }
            }));
        Context context = make(loader.host());
        const Scene scene(context);
        HostFrames frames(strict.device(), 1);
        (void)scene.run(scene.every());
        (void)scene.record(scene.every(), frames, 0);
        (void)scene.run(resident_queries(scene.every()));
        (void)scene.run(scene.small(0.004));
        context.trim();
        (void)scene.record(resident_queries(scene.every()), frames, 1);
    }
    EXPECT_EQ(messages_of(about_allocations, strict.messages()), std::vector<std::string>{});
    EXPECT_EQ(messages_of(about_push_constants, strict.messages()), std::vector<std::string>{});
    EXPECT_GT(most, 0U);
    EXPECT_LT(most, 24U);
    strict.close();
}

TEST_F(HostTable, Memory) {
    make_host();
    CountingAllocator counting;
    const VkAllocationCallbacks callbacks = counting.callbacks();
    std::map<std::string, int> without;
    int with = 0;
    {
        HostDevice device = watch([&](const WatchedCall& call) {
            if (call.makes() || call.destroys()) {
                const bool ours =
                    call.allocator != nullptr && call.allocator->pUserData == callbacks.pUserData;
                with += ours ? 1 : 0;
                without[std::string(call.name)] += ours || !call.takes_allocator ? 0 : 1;
            }
        });
        std::optional<VkAllocationCallbacks> borrowed = callbacks;
        device.allocator = &*borrowed;
        Context context = make(device);
        borrowed = VkAllocationCallbacks{};  // copied: only the objects it points to must stay
                                             // alive
        const Scene scene(context);
        HostFrames frames(host(), 1);
        (void)scene.run(scene.every());
        (void)scene.record(scene.every(), frames, 0);
        const MemoryUse use = context.memory_use();
        EXPECT_GT(use.in_use, 1U << 16U);
        EXPECT_GE(use.peak, use.in_use);
        // Larger images replace smaller ones: the peak stays recorded after they are destroyed.
        (void)scene.run(scene.small(0.001));
        EXPECT_GT(context.memory_use().peak, use.peak);
        const MemoryUse grown = context.memory_use();
        (void)scene.run(scene.small(0.001));
        EXPECT_EQ(context.memory_use().in_use, grown.in_use);
        EXPECT_EQ(context.memory_use().peak, grown.peak);
        EXPECT_GT(counting.in_use, 0);
    }
    EXPECT_EQ(counting.in_use, 0);
    EXPECT_GT(counting.given, 100);
    EXPECT_GT(with, 100);
    for (const auto& [name, count] : without) {
        EXPECT_EQ(count, 0) << name;
    }
}

TEST_F(HostTable, Pipelines) {
    make_host();
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    VkPipelineCache cache = VK_NULL_HANDLE;
    ASSERT_EQ(test_support::host_function<PFN_vkCreatePipelineCache>(
                  host(), "vkCreatePipelineCache")(host().device, &info, nullptr, &cache),
              VK_SUCCESS);
    int pipelines = 0;
    int with_cache = 0;
    {
        HostDevice device = watch([&](const WatchedCall& call) {
            const bool is_pipeline =
                call.name.starts_with("vkCreate") && call.name.ends_with("Pipelines");
            pipelines += is_pipeline ? 1 : 0;
            with_cache += is_pipeline && call.pipeline_cache == cache ? 1 : 0;
        });
        device.pipeline_cache = cache;
        Context context = *Context::create(device);
        EXPECT_GT(pipelines, 10);
        EXPECT_EQ(with_cache, pipelines);
        const int at_creation = pipelines;
        const Scene scene(context);
        HostFrames frames(host(), 1);
        (void)scene.run(scene.every());
        (void)scene.record(scene.every(), frames, 0);
        EXPECT_EQ(pipelines, at_creation);
    }
    // It still belongs to the host.
    std::size_t size = 0;
    EXPECT_EQ(test_support::host_function<PFN_vkGetPipelineCacheData>(
                  host(), "vkGetPipelineCacheData")(host().device, cache, &size, nullptr),
              VK_SUCCESS);
    EXPECT_GT(size, 0U);
    test_support::host_function<PFN_vkDestroyPipelineCache>(host(), "vkDestroyPipelineCache")(
        host().device, cache, nullptr);
}

TEST_F(HostTable, Shaders) {
    // All are created with the pipelines and destroyed when the context is complete, and no
    // compiler is loaded.
    make_host();
    std::int64_t alive = 0;
    int made = 0;
    const HostDevice device = watch([&](const WatchedCall& call) {
        alive += call.name == "vkCreateShaderModule" ? 1 : 0;
        made += call.name == "vkCreateShaderModule" ? 1 : 0;
        alive -= call.name == "vkDestroyShaderModule" ? 1 : 0;
    });
    Context context = *Context::create(device);
    EXPECT_GT(made, 10);
    EXPECT_EQ(alive, 0);
    const int at_creation = made;
    const Scene scene(context);
    (void)scene.run(scene.every());
    EXPECT_EQ(made, at_creation);
    std::ifstream maps("/proc/self/maps");
    ASSERT_TRUE(maps.good());
    for (std::string line; std::getline(maps, line);) {
        EXPECT_EQ(line.find("/libglslang"), std::string::npos) << line;
        EXPECT_EQ(line.find("/libshaderc"), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace nearfield::test
