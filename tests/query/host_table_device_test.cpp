#include <tests/query/host_table.hpp>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::VulkanHost;

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
    static PFN_vkGetInstanceProcAddr below = nullptr;
    below = lacking.get_instance_proc_addr;
    lacking.get_instance_proc_addr = [](VkInstance instance, const char* name) {
        return std::string(name) == "vkGetPhysicalDeviceMemoryProperties" ? nullptr
                                                                          : below(instance, name);
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

}  // namespace
}  // namespace nearfield::test
