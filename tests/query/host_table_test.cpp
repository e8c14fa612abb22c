#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/vulkan_host.hpp>
#include <tests/support/watched_loader.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

// What a host wants of a library inside its Vulkan device: a test for each row of that table, named
// after it. Every device here is under the validation layers.

namespace nearfield::test {
namespace {

using test_support::Enabled;
using test_support::HostFrames;
using test_support::VulkanHost;
using test_support::WatchedCall;

constexpr std::uint64_t seed = 8000;

/// Two shapes of a context and what can be asked of them.
struct Scene {
    explicit Scene(Context& owner) : context(&owner) {
        Random random(seed);
        const Expected<ShapeHandle> first = owner.add_shape(coast(random, 100, 0.5));
        const Expected<ShapeHandle> second = owner.add_shape(with_holes(random, 3));
        EXPECT_TRUE(first.ok() && second.ok());
        a = *first;
        b = *second;
    }

    [[nodiscard]] Batch every(bool recordable = false) const {
        return every_query(a, b, 0, recordable);
    }
    [[nodiscard]] Batch small(double tolerance = 0.1) const {
        Batch batch;
        IntersectionQuery query{{a, {}}, {b, {}}, tolerance};
        query.records = false;
        batch.add(query);
        return batch;
    }
    [[nodiscard]] Batch on_cpu() const {
        Batch batch;
        batch.add(SeparationQuery{{a, {}}, {b, {{3.0, 0.0}, 0.0}}, 0.1, Technique::cpu});
        return batch;
    }

    [[nodiscard]] std::vector<double> run(const Batch& batch) const {
        Results results;
        const Status status = context->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        expect_answers(results);
        return all_numbers(results);
    }
    [[nodiscard]] std::vector<double> collect(const Expected<Ticket>& ticket) const {
        EXPECT_TRUE(ticket.ok()) << ticket.status().text();
        if (!ticket.ok()) {
            return {};
        }
        Results results;
        const Status status = context->collect(*ticket, results);
        EXPECT_TRUE(status.ok()) << status.text();
        expect_answers(results);
        return all_numbers(results);
    }
    static void expect_answers(const Results& results) {
        for (std::size_t i = 0; i < results.results.size(); ++i) {
            std::visit(
                [&](const auto& result) {
                    EXPECT_TRUE(result.status.ok()) << i << ": " << result.status.text();
                },
                results.results[i]);
        }
    }
    /// One frame of a host that records.
    [[nodiscard]] std::vector<double> record(const Batch& batch, HostFrames& host,
                                             std::uint64_t frame) const {
        const Expected<Ticket> ticket =
            context->record(batch, {.commands = host.begin(frame), .frame = frame});
        host.submit(frame);
        host.wait(frame);
        context->frame_completed(frame);
        return collect(ticket);
    }

    Context* context;
    ShapeHandle a;
    ShapeHandle b;
};

class HostTable : public testing::Test {
protected:
    /// The device that a test is about; bare unless asked for.
    const HostDevice& make_host(const Enabled& enabled = {}) {
        host_.emplace(enabled);
        return host_->device();
    }
    [[nodiscard]] const HostDevice& host() const { return host_->device(); }

    /// Watches every call that contexts on the returned device make.
    const HostDevice& watch(std::function<void(const WatchedCall&)> watcher) {
        loader_.emplace(host(), test_support::watched(host(), std::move(watcher)));
        return loader_->host();
    }

    static Context make(const HostDevice& device, std::uint32_t frames = 2) {
        Settings settings;
        settings.frames_in_flight = frames;
        Expected<Context> made = Context::create(device, drawing(settings));
        if (!made.ok()) {
            throw std::runtime_error(made.status().text());
        }
        return std::move(*made);
    }

    void TearDown() override {
        loader_.reset();
        EXPECT_EQ(host_->close(), std::vector<std::string>{});
    }

private:
    std::optional<VulkanHost> host_;
    std::optional<test_support::FakeLoader> loader_;
};

// Entry points asked for, through the one function that a host hands over.

std::set<std::string>* names_asked = nullptr;
PFN_vkGetInstanceProcAddr true_get_instance = nullptr;
PFN_vkGetDeviceProcAddr true_get_device = nullptr;

PFN_vkVoidFunction VKAPI_CALL asked_of_device(VkDevice device, const char* name) {
    names_asked->insert(name);
    return true_get_device(device, name);
}

PFN_vkVoidFunction VKAPI_CALL asked_of_instance(VkInstance instance, const char* name) {
    names_asked->insert(name);
    if (std::string(name) == "vkGetDeviceProcAddr") {
        return reinterpret_cast<PFN_vkVoidFunction>(&asked_of_device);
    }
    return true_get_instance(instance, name);
}

/// The host, with every name noted that the library asks for.
HostDevice noting_names(const HostDevice& host, std::set<std::string>& names) {
    names_asked = &names;
    true_get_instance = host.get_instance_proc_addr;
    true_get_device =
        test_support::host_function<PFN_vkGetDeviceProcAddr>(host, "vkGetDeviceProcAddr");
    HostDevice noting = host;
    noting.get_instance_proc_addr = &asked_of_instance;
    return noting;
}

TEST_F(HostTable, Loader) {
    make_host();
    std::set<std::string> names;
    {
        Context context = make(noting_names(host(), names));
        const Scene scene(context);
        HostFrames frames(host(), 2);
        EXPECT_EQ(scene.record(scene.every(true), frames, 0), scene.run(scene.every(true)));
    }
    EXPECT_GT(names.size(), 70U);
    EXPECT_TRUE(names.contains("vkCreateComputePipelines"));
    // A name that cannot be had is an error that says so.
    HostDevice lacking = host();
    lacking.get_instance_proc_addr = [](VkInstance instance, const char* name) {
        return std::string(name) == "vkGetPhysicalDeviceMemoryProperties"
                   ? nullptr
                   : true_get_instance(instance, name);
    };
    const Status status = Context::create(lacking).status();
    EXPECT_EQ(status.code(), StatusCode::unsupported_device);
    ASSERT_EQ(status.reasons().size(), 1U);
    EXPECT_EQ(status.reasons()[0].find("entry point vkGetPhysicalDeviceMemoryProperties: "), 0U);
}

PhysicalDevice physical_device_of(const HostDevice& host) {
    PhysicalDevice device;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.get_instance_proc_addr = host.get_instance_proc_addr;
    device.debug_utils = host.debug_utils;
    return device;
}

TEST_F(HostTable, Requirements) {
    // What is said to be needed before there is a device is what a context needs of it: nothing
    // enabled, and a queue of the family named.
    make_host();
    const Expected<Requirements> needed = requirements(physical_device_of(host()));
    ASSERT_TRUE(needed.ok()) << needed.status().text();
    EXPECT_TRUE(needed->met());
    EXPECT_EQ(needed->queue_family, host().queue_family);
    {
        Context context = make(host());
        const Scene scene(context);
        EXPECT_FALSE(scene.run(scene.every()).empty());
    }
    // All that is optional can be enabled just as it is listed.
    ASSERT_EQ(needed->device_extensions.size(), 1U);
    VulkanHost full({needed->features, needed->timeline_semaphore.timelineSemaphore == VK_TRUE});
    {
        Context context = make(full.device());
        const Scene scene(context);
        Batch batch = scene.every();
        batch.add(IntersectionQuery{{scene.a, {}},
                                    {scene.b, {}},
                                    0.1,
                                    IntersectionKind::volume_volume,
                                    true,
                                    IntersectionStrategy::logic_op,
                                    Technique::raster});
        EXPECT_FALSE(scene.run(batch).empty());
    }
    EXPECT_EQ(full.close(), std::vector<std::string>{});
}

TEST_F(HostTable, EnabledSet) {
    // The physical device has it all; the device has what the host says.
    make_host();
    ASSERT_EQ(requirements(physical_device_of(host()))->features.logicOp, VK_TRUE);
    Context context = make(host());
    const Scene scene(context);
    Batch batch;
    batch.add(IntersectionQuery{{scene.a, {}},
                                {scene.b, {}},
                                0.1,
                                IntersectionKind::volume_volume,
                                true,
                                IntersectionStrategy::logic_op,
                                Technique::raster});
    Results results;
    ASSERT_TRUE(context.run(batch, results).ok());
    EXPECT_EQ(std::get<IntersectionResult>(results.results[0]).status.code(),
              StatusCode::unsupported_strategy);
    const SemaphoreSignal timeline{reinterpret_cast<VkSemaphore>(std::uintptr_t{1}), 7};
    const Status refused = context.submit(batch, {.signals = {&timeline, 1}}).status();
    EXPECT_EQ(refused.code(), StatusCode::invalid_submission);
    EXPECT_NE(refused.message().find("Submission::signals[0].value"), std::string::npos);
    EXPECT_NE(refused.message().find("HostDevice::timeline_semaphore"), std::string::npos);
    HostDevice quiet = host();
    quiet.debug_utils = false;
    std::set<std::string> names;
    (void)make(noting_names(quiet, names));
    for (const std::string& name : names) {
        EXPECT_EQ(name.find("DebugUtils"), std::string::npos) << name;
    }
}

TEST_F(HostTable, Work) {
    make_host();
    int submissions = 0;
    Context context = make(watch(
        [&](const WatchedCall& call) { submissions += call.name == "vkQueueSubmit" ? 1 : 0; }));
    const Scene scene(context);
    HostFrames frames(host(), 2);
    const Batch batch = scene.every(true);
    const std::vector<double> submitted = scene.collect(context.submit(batch));
    EXPECT_EQ(submissions, 1);
    EXPECT_EQ(scene.record(batch, frames, 0), submitted);
    EXPECT_EQ(submissions, 1);
}

VkSemaphore make_semaphore(const HostDevice& host, bool timeline) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = timeline ? &type : nullptr;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    EXPECT_EQ(test_support::host_function<PFN_vkCreateSemaphore>(host, "vkCreateSemaphore")(
                  host.device, &info, nullptr, &semaphore),
              VK_SUCCESS);
    return semaphore;
}

void destroy_semaphore(const HostDevice& host, VkSemaphore semaphore) {
    test_support::host_function<PFN_vkDestroySemaphore>(host, "vkDestroySemaphore")(
        host.device, semaphore, nullptr);
}

TEST_F(HostTable, HandOff) {
    Enabled enabled;
    enabled.timeline_semaphore = true;
    make_host(enabled);
    VkSemaphore const timeline = make_semaphore(host(), true);
    VkSemaphore const binary = make_semaphore(host(), false);
    const auto counter = [&] {
        std::uint64_t value = 0;
        EXPECT_EQ(test_support::host_function<PFN_vkGetSemaphoreCounterValueKHR>(
                      host(), "vkGetSemaphoreCounterValueKHR")(host().device, timeline, &value),
                  VK_SUCCESS);
        return value;
    };
    const auto signal = [&](std::uint64_t value) {
        VkSemaphoreSignalInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
        info.semaphore = timeline;
        info.value = value;
        EXPECT_EQ(test_support::host_function<PFN_vkSignalSemaphoreKHR>(
                      host(), "vkSignalSemaphoreKHR")(host().device, &info),
                  VK_SUCCESS);
    };
    const auto wait_for = [&](std::uint64_t value) {
        VkSemaphoreWaitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
        info.semaphoreCount = 1;
        info.pSemaphores = &timeline;
        info.pValues = &value;
        EXPECT_EQ(test_support::host_function<PFN_vkWaitSemaphoresKHR>(
                      host(), "vkWaitSemaphoresKHR")(host().device, &info, UINT64_MAX),
                  VK_SUCCESS);
    };
    {
        Context context = make(host());
        const Scene scene(context);
        const std::vector<double> expected = scene.run(scene.small());
        // One waits for the host, the other for the first by the binary semaphore.
        const SemaphoreWait for_host{timeline, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 1};
        const std::array<SemaphoreSignal, 2> both{{{timeline, 2}, {binary, 0}}};
        const SemaphoreWait for_first{binary};
        const SemaphoreSignal last{timeline, 3};
        // Whether the device has anything to do or not.
        for (const bool device_works : {true, false}) {
            SCOPED_TRACE(device_works);
            const std::uint64_t base = counter();
            const auto later = [&](auto semaphore) {
                semaphore.value += semaphore.value == 0 ? 0 : base;
                return semaphore;
            };
            const std::array<SemaphoreSignal, 2> signals{later(both[0]), later(both[1])};
            const SemaphoreWait wait = later(for_host);
            const SemaphoreSignal end = later(last);
            const Batch batch = device_works ? scene.small() : scene.on_cpu();
            const Expected<Ticket> first =
                context.submit(batch, {.waits = {&wait, 1}, .signals = signals});
            ASSERT_TRUE(first.ok()) << first.status().text();
            EXPECT_EQ(context.is_ready(*first), !device_works);
            EXPECT_EQ(counter(), base);
            signal(base + 1);
            const Expected<Ticket> second =
                context.submit(batch, {.waits = {&for_first, 1}, .signals = {&end, 1}});
            ASSERT_TRUE(second.ok()) << second.status().text();
            wait_for(base + 3);
            const std::vector<double> numbers = scene.collect(first);
            EXPECT_EQ(scene.collect(second), numbers);
            EXPECT_EQ(device_works ? numbers : expected, expected);
        }
        // What cannot be used is said by name, and nothing is submitted.
        const std::uint64_t before = counter();
        const auto refusal = [&](const Submission& submission) {
            const Status status = context.submit(scene.small(), submission).status();
            EXPECT_EQ(status.code(), StatusCode::invalid_submission) << status.text();
            return status.message();
        };
        const SemaphoreWait null_wait{};
        const SemaphoreWait no_stage{binary, 0};
        const SemaphoreSignal null_signal{};
        EXPECT_NE(refusal({.waits = {&null_wait, 1}}).find("waits[0].semaphore"),
                  std::string::npos);
        EXPECT_NE(refusal({.waits = {&no_stage, 1}}).find("waits[0].stages"), std::string::npos);
        EXPECT_NE(refusal({.signals = {&null_signal, 1}}).find("signals[0].semaphore"),
                  std::string::npos);
        EXPECT_EQ(counter(), before);
    }
    destroy_semaphore(host(), timeline);
    destroy_semaphore(host(), binary);
}

TEST_F(HostTable, Waits) {
    make_host();
    std::set<std::string> names;
    {
        // Made, grown, lost sight of and destroyed, in both ways of working.
        Context context = make(noting_names(host(), names));
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.small(), frames, 0);
        (void)scene.run(scene.small(0.002));
        const Expected<Ticket> ticket = context.submit(scene.small());
        EXPECT_TRUE(ticket.ok());
    }
    EXPECT_TRUE(names.contains("vkWaitForFences"));
    EXPECT_FALSE(names.contains("vkDeviceWaitIdle"));
    EXPECT_FALSE(names.contains("vkQueueWaitIdle"));
    // Each of its own submissions is waited for once, and nothing of what is recorded.
    int waits = 0;
    {
        Context context =
            make(watch([&](const WatchedCall& call) { waits += call.name == "vkWaitForFences"; }));
        EXPECT_EQ(waits, 0);
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.every(true), frames, 0);
        (void)scene.record(scene.small(0.002), frames, 1);
        EXPECT_EQ(waits, 0);
        (void)scene.run(scene.small());
        EXPECT_EQ(waits, 1);
        const Expected<Ticket> recorded =
            context.record(scene.small(), {.commands = frames.begin(2), .frame = 2});
        EXPECT_TRUE(recorded.ok());
        frames.abandon(2);
    }
    EXPECT_EQ(waits, 1);
}

TEST_F(HostTable, Lifetime) {
    make_host();
    for (std::uint32_t in_flight = 1; in_flight <= most_frames_in_flight; ++in_flight) {
        SCOPED_TRACE(in_flight);
        Context context = make(host(), in_flight);
        const Scene scene(context);
        HostFrames frames(host(), in_flight);
        // Each needs a larger atlas than the one before, which is still in flight.
        std::vector<Expected<Ticket>> tickets;
        std::vector<Batch> batches;
        for (std::uint32_t frame = 0; frame < in_flight; ++frame) {
            batches.push_back(scene.small(0.2 / (1U << frame)));
            tickets.push_back(
                context.record(batches.back(), {.commands = frames.begin(frame), .frame = frame}));
            frames.submit(frame);
        }
        EXPECT_EQ(
            context
                .record(batches[0], {.commands = frames.begin(in_flight), .frame = in_flight - 1})
                .status()
                .code(),
            StatusCode::ring_full);
        frames.abandon(in_flight);
        frames.wait(in_flight - 1);
        context.frame_completed(in_flight - 1);
        std::vector<std::vector<double>> answers;
        for (const Expected<Ticket>& ticket : tickets) {
            answers.push_back(scene.collect(ticket));
        }
        for (std::uint32_t frame = 0; frame < in_flight; ++frame) {
            EXPECT_EQ(answers[frame], scene.run(batches[frame])) << "frame " << frame;
        }
    }
}

/// Callbacks of a host, which count what they give and take.
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
        borrowed = VkAllocationCallbacks{};  // copied: what it points to has to live, not it
        const Scene scene(context);
        HostFrames frames(host(), 1);
        (void)scene.run(scene.every());
        (void)scene.record(scene.every(true), frames, 0);
        const MemoryUse use = context.memory_use();
        EXPECT_GT(use.in_use, 1U << 16U);
        EXPECT_GE(use.peak, use.in_use);
        // Larger images take the place of smaller ones: the peak stays when they have gone.
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
        Context context = make(device);
        EXPECT_GT(pipelines, 10);
        EXPECT_EQ(with_cache, pipelines);
        const int at_creation = pipelines;
        const Scene scene(context);
        HostFrames frames(host(), 1);
        (void)scene.run(scene.every());
        (void)scene.record(scene.every(true), frames, 0);
        EXPECT_EQ(pipelines, at_creation);
    }
    // It is the host's still.
    std::size_t size = 0;
    EXPECT_EQ(test_support::host_function<PFN_vkGetPipelineCacheData>(
                  host(), "vkGetPipelineCacheData")(host().device, cache, &size, nullptr),
              VK_SUCCESS);
    EXPECT_GT(size, 0U);
    test_support::host_function<PFN_vkDestroyPipelineCache>(host(), "vkDestroyPipelineCache")(
        host().device, cache, nullptr);
}

TEST_F(HostTable, Shaders) {
    // All are made with the pipelines, gone when the context is made, and no compiler is loaded.
    make_host();
    std::int64_t alive = 0;
    int made = 0;
    Context context = make(watch([&](const WatchedCall& call) {
        alive += call.name == "vkCreateShaderModule" ? 1 : 0;
        made += call.name == "vkCreateShaderModule" ? 1 : 0;
        alive -= call.name == "vkDestroyShaderModule" ? 1 : 0;
    }));
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

// Names and labels, as they pass by.

struct Debugging {
    std::set<std::uint64_t> named;
    std::vector<std::string> labels;
    int open = 0;
};
Debugging debugging;

TEST_F(HostTable, Debugging) {
    make_host();
    debugging = {};
    std::map<std::uint64_t, std::string> made;
    test_support::Lies lies = test_support::watched(host(), [&](const WatchedCall& call) {
        if (call.makes() && call.made != 0) {
            made[call.made] = call.name;
        }
    });
    static PFN_vkSetDebugUtilsObjectNameEXT name_below = nullptr;
    static PFN_vkCmdBeginDebugUtilsLabelEXT begin_below = nullptr;
    static PFN_vkCmdEndDebugUtilsLabelEXT end_below = nullptr;
    const auto lie = [&lies](const char* name, auto& below, auto instead) {
        below = reinterpret_cast<std::remove_reference_t<decltype(below)>>(lies.entry_points[name]);
        lies.entry_points[name] =
            reinterpret_cast<PFN_vkVoidFunction>(std::remove_reference_t<decltype(below)>(instead));
    };
    lie("vkSetDebugUtilsObjectNameEXT", name_below,
        [](VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
            EXPECT_NE(std::string(info->pObjectName), "");
            debugging.named.insert(info->objectHandle);
            return name_below(device, info);
        });
    lie("vkCmdBeginDebugUtilsLabelEXT", begin_below,
        [](VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
            debugging.labels.emplace_back(label->pLabelName);
            ++debugging.open;
            begin_below(commands, label);
        });
    lie("vkCmdEndDebugUtilsLabelEXT", end_below, [](VkCommandBuffer commands) {
        --debugging.open;
        end_below(commands);
    });
    const test_support::FakeLoader loader(host(), lies);
    Context context = make(loader.host());
    const Scene scene(context);
    HostFrames frames(host(), 1);
    Results results;
    ASSERT_TRUE(context.run(scene.every(), results).ok());
    EXPECT_GT(results.timings.passes.size(), 10U);
    for (const PassTime& pass : results.timings.passes) {
        EXPECT_GE(pass.milliseconds, 0.0) << pass.name;
        EXPECT_NE(std::find(debugging.labels.begin(), debugging.labels.end(), pass.name),
                  debugging.labels.end())
            << pass.name;
    }
    debugging.labels.clear();
    (void)scene.record(scene.every(true), frames, 0);
    ASSERT_FALSE(debugging.labels.empty());
    EXPECT_EQ(debugging.labels.front(), "nearfield");  // around all that is in the host's buffer
    EXPECT_EQ(debugging.open, 0);
    for (const auto& [object, call] : made) {
        EXPECT_TRUE(debugging.named.contains(object)) << call << " made an object without a name";
    }
    EXPECT_GT(made.size(), 100U);
}

// A device that is lost when it is told to be.

bool device_is_lost = false;

VkResult VKAPI_CALL submit_or_lose(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                   VkFence fence) {
    return device_is_lost ? VK_ERROR_DEVICE_LOST
                          : reinterpret_cast<PFN_vkQueueSubmit>(test_support::true_device_function(
                                "vkQueueSubmit"))(queue, count, infos, fence);
}

TEST_F(HostTable, Errors) {
    make_host();
    test_support::Lies lies;
    lies.entry_points["vkQueueSubmit"] = reinterpret_cast<PFN_vkVoidFunction>(&submit_or_lose);
    const test_support::FakeLoader loader(host(), lies);
    std::vector<std::string> said;
    HostDevice device = loader.host();
    device.log.user = &said;
    device.log.write = [](void* user, LogLevel level, const char* message) {
        if (level == LogLevel::error) {
            static_cast<std::vector<std::string>*>(user)->emplace_back(message);
        }
    };
    for (int life = 0; life < 2; ++life) {
        device_is_lost = false;
        Context context = make(device);
        const Scene scene(context);
        HostFrames frames(host(), 1);
        const std::vector<double> expected = scene.run(scene.small());
        const Expected<Ticket> recorded =
            context.record(scene.small(), {.commands = frames.begin(0), .frame = 0});
        frames.abandon(0);
        device_is_lost = true;
        Results results;
        for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(context.run(scene.small(), results).code(), StatusCode::device_lost);
        }
        EXPECT_EQ(context.submit(scene.small()).status().code(), StatusCode::device_lost);
        EXPECT_EQ(context.record(scene.small(), {.commands = frames.begin(1), .frame = 1})
                      .status()
                      .code(),
                  StatusCode::device_lost);
        frames.abandon(1);
        ASSERT_TRUE(recorded.ok());
        EXPECT_TRUE(context.is_ready(*recorded));
        EXPECT_EQ(context.collect(*recorded, results).code(), StatusCode::device_lost);
        EXPECT_EQ(context.collect(*recorded, results).code(), StatusCode::unknown_ticket);
        ASSERT_EQ(said.size(), 1U) << "once";
        EXPECT_NE(said[0].find("vkQueueSubmit"), std::string::npos) << said[0];
        said.clear();
    }
}

/// A queue that several threads use, each through a context of its own.
struct SharedQueue {
    std::mutex mutex;
    std::atomic<int> inside{0};
    std::atomic<int> locked{0};
    std::atomic<int> collisions{0};
    std::atomic<int> submitted{0};
    HostDevice host;

    void enter() {
        mutex.lock();
        collisions += inside++ == 0 ? 0 : 1;
        ++locked;
    }
    void leave() {
        --inside;
        mutex.unlock();
    }
    VkResult submit(std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
        ++submitted;
        enter();
        const VkResult result = test_support::host_function<PFN_vkQueueSubmit>(
            host, "vkQueueSubmit")(host.queue, count, infos, fence);
        leave();
        return result;
    }
};

TEST_F(HostTable, Threads) {
    make_host();
    SharedQueue queue;
    queue.host = host();
    HostDevice locking = host();
    locking.queue_access.user = &queue;
    locking.queue_access.lock = [](void* user) { static_cast<SharedQueue*>(user)->enter(); };
    locking.queue_access.unlock = [](void* user) { static_cast<SharedQueue*>(user)->leave(); };
    // A host whose queue can be had through its own function alone.
    HostDevice by_host = host();
    by_host.queue = VK_NULL_HANDLE;
    by_host.queue_access.user = &queue;
    by_host.queue_access.submit = [](void* user, std::uint32_t count, const VkSubmitInfo* infos,
                                     VkFence fence) {
        return static_cast<SharedQueue*>(user)->submit(count, infos, fence);
    };
    constexpr int rounds = 5;
    std::vector<std::vector<double>> answers(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        threads.emplace_back([&, i] {
            Context context = make(i % 2 == 0 ? locking : by_host);
            const Scene scene(context);
            for (int round = 0; round < rounds; ++round) {
                answers[i] = scene.run(scene.small());
            }
            const Expected<Ticket> in_flight = context.submit(scene.small());
            EXPECT_TRUE(in_flight.ok());
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_FALSE(answers[0].empty());
    for (const std::vector<double>& answer : answers) {
        EXPECT_EQ(answer, answers[0]);
    }
    EXPECT_EQ(queue.collisions, 0);
    EXPECT_EQ(queue.inside, 0);
    EXPECT_EQ(queue.locked, 4 * (rounds + 1));
    EXPECT_EQ(queue.submitted, 2 * (rounds + 1));
    // Half of a lock is none.
    HostDevice half = locking;
    half.queue_access.unlock = nullptr;
    const Status status = Context::create(half).status();
    EXPECT_EQ(status.code(), StatusCode::unsupported_device);
    ASSERT_EQ(status.reasons().size(), 1U);
    EXPECT_NE(status.reasons()[0].find("queue_access.unlock"), std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
