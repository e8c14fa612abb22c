#include <tests/query/device_offers.hpp>
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
        EXPECT_EQ(scene.record(scene.every(), frames, 0), scene.run(scene.every()));
    }
    EXPECT_GT(names.size(), 70U);
    EXPECT_TRUE(names.contains("vkCreateComputePipelines"));
    // A missing entry point is reported as an error.
    HostDevice lacking = host();
    static PFN_vkGetInstanceProcAddr below = nullptr;
    below = lacking.get_instance_proc_addr;
    lacking.get_instance_proc_addr = [](VkInstance instance, const char* name) {
        return std::string(name) == "vkGetPhysicalDeviceMemoryProperties" ? nullptr
                                                                          : below(instance, name);
    };
    const Status status = Context::create(lacking).error();
    EXPECT_EQ(status.code(), StatusCode::unsupported_device);
    ASSERT_EQ(status.reasons().size(), 1U);
    EXPECT_EQ(status.reasons()[0].find("entry point vkGetPhysicalDeviceMemoryProperties: "), 0U);
}

/// Uses a strategy that needs the feature logicOp.
IntersectionQuery by_logic_op(const Scene& scene) {
    IntersectionQuery query{{scene.a, {}}, {scene.b, {}}, 0.1};
    query.strategy = IntersectionStrategy::logic_op;
    query.technique = Technique::raster;
    return query;
}

TEST_F(HostTable, Requirements) {
    // The requirements reported before there is a device are those of a context: nothing enabled,
    // and a queue of the named family.
    make_host();
    const Expected<Requirements> needed = requirements(physical_device_of(host()));
    ASSERT_TRUE(needed.has_value()) << needed.error().text();
    EXPECT_TRUE(needed->met());
    EXPECT_EQ(needed->queue_family, host().queue_family);
    {
        Context context = make(host());
        const Scene scene(context);
        EXPECT_FALSE(scene.run(scene.every()).empty());
    }
    // Every listed optional part can be enabled as listed, and unlisted parts are unavailable.
    const bool timelines = needed->timeline_semaphore.timelineSemaphore == VK_TRUE;
    VulkanHost full({needed->features, timelines});
    EXPECT_EQ(full.device().logic_op, needed->features.logicOp == VK_TRUE);
    EXPECT_EQ(full.device().logic_op, full.offered().features.logicOp == VK_TRUE);
    EXPECT_EQ(full.device().timeline_semaphore, timelines);
    EXPECT_EQ(full.offered().timeline_semaphore, timelines);
    EXPECT_EQ(needed->device_extensions.size(), timelines ? 1U : 0U);
    {
        Context context = make(full.device());
        const Scene scene(context);
        EXPECT_FALSE(scene.run(scene.every()).empty());
        const IntersectionResult result = run_alone(context, by_logic_op(scene));
        if (full.device().logic_op) {
            EXPECT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_GT(result.count, 0U);
        } else {
            expect_logic_op_refused(result);
        }
    }
    EXPECT_EQ(full.close(), std::vector<std::string>{});
}

TEST_F(HostTable, EnabledSet) {
    // Whatever the physical device supports, the device has only what the host reports: nothing.
    make_host();
    Context context = make(host());
    const Scene scene(context);
    expect_logic_op_refused(run_alone(context, by_logic_op(scene)));
    expect_timelines_refused(context, scene.small());
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
