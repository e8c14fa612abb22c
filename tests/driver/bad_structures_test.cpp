#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>
#include <tests/support/techniques.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

template <class Enumeration>
Enumeration beyond(Enumeration last) {
    return static_cast<Enumeration>(static_cast<int>(last) + 1);
}

/// Invalid structures from a host are rejected by name before any driver call.
class BadStructures : public ::testing::Test {
protected:
    ~BadStructures() override {
        EXPECT_EQ(driver_.alive(), std::vector<std::string>{});
        EXPECT_EQ(driver_.breaches(), std::vector<std::string>{});
    }

    void expect_refused(const Status& status, StatusCode code, const std::string& part) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.text().find(part), std::string::npos) << status.text();
        EXPECT_TRUE(driver_.calls().empty()) << "first " << driver_.calls().front();
        driver_.forget_calls();
    }
    void expect_refused(const Settings& settings, const std::string& part) {
        SCOPED_TRACE(part);
        expect_refused(Context::create(driver_.host(), settings).error(),
                       StatusCode::invalid_settings, part);
        expect_refused(Context::create_headless({}, settings).error(), StatusCode::invalid_settings,
                       part);
    }

    test_support::MockDriver driver_;
};

TEST_F(BadStructures, VersionsThatAreNoneOfVulkan1) {
    PhysicalDevice device;
    device.instance = driver_.host().instance;
    device.physical_device = driver_.host().physical_device;
    device.get_instance_proc_addr = driver_.host().get_instance_proc_addr;
    for (const std::uint32_t version :
         {0xFFFFFFFFU, 1U, 11U, VK_MAKE_API_VERSION(0, 2, 0, 0), VK_MAKE_API_VERSION(1, 1, 0, 0)}) {
        SCOPED_TRACE(version);
        HostDevice host = driver_.host();
        host.api_version = device.api_version = version;
        const std::string words = "::api_version is " + std::to_string(version) + ", which is no";
        expect_refused(Context::create(host).error(), StatusCode::invalid_settings,
                       "HostDevice" + words);
        expect_refused(requirements(device).error(), StatusCode::invalid_settings,
                       "PhysicalDevice" + words);
    }
    for (const std::uint32_t version :
         {VK_API_VERSION_1_1, VK_API_VERSION_1_2, VK_API_VERSION_1_3}) {
        HostDevice host = driver_.host();
        host.api_version = device.api_version = version;
        EXPECT_TRUE(Context::create(host).has_value());
        EXPECT_TRUE(requirements(device)->met());
    }
    // A version that exists but is too low: the message lists what the instance lacks as for a
    // device.
    HostDevice host = driver_.host();
    host.api_version = device.api_version = VK_API_VERSION_1_0;
    const Status old = Context::create(host).error();
    EXPECT_EQ(old.code(), StatusCode::unsupported_device);
    EXPECT_NE(old.text().find("the instance was created for Vulkan 1.0 only"), std::string::npos)
        << old.text();
    EXPECT_FALSE(requirements(device)->met());
}

TEST_F(BadStructures, AllocationCallbacksWithoutFunctions) {
    const HostDevice good = driver_.host();
    const auto try_without = [&](auto VkAllocationCallbacks::*function, const std::string& name) {
        VkAllocationCallbacks callbacks = *good.allocator;
        callbacks.pfnInternalAllocation = [](void*, std::size_t, VkInternalAllocationType,
                                             VkSystemAllocationScope) {};
        callbacks.pfnInternalFree = [](void*, std::size_t, VkInternalAllocationType,
                                       VkSystemAllocationScope) {};
        callbacks.*function = nullptr;
        HostDevice host = good;
        host.allocator = &callbacks;
        expect_refused(Context::create(host).error(), StatusCode::unsupported_device,
                       "HostDevice::allocator->" + name + ": it is null");
    };
    try_without(&VkAllocationCallbacks::pfnAllocation, "pfnAllocation");
    try_without(&VkAllocationCallbacks::pfnReallocation, "pfnReallocation");
    try_without(&VkAllocationCallbacks::pfnFree, "pfnFree");
    try_without(&VkAllocationCallbacks::pfnInternalAllocation, "pfnInternalAllocation");
    try_without(&VkAllocationCallbacks::pfnInternalFree, "pfnInternalFree");
}

TEST_F(BadStructures, HalfAnAllocatorOfDeviceMemory) {
    HostDevice host = driver_.host();
    host.memory.allocate = [](void*, const MemoryRequest*, MemoryAllocation*) {
        return VK_SUCCESS;
    };
    expect_refused(Context::create(host).error(), StatusCode::invalid_settings,
                   "HostDevice::memory.free is null, and allocate is set");
    host.memory.allocate = nullptr;
    host.memory.free = [](void*, const MemoryAllocation*) {};
    expect_refused(Context::create(host).error(), StatusCode::invalid_settings,
                   "HostDevice::memory.allocate is null, and free is set");
}

TEST_F(BadStructures, SettingsThatAreNoEnumerators) {
    Settings settings;
    settings.bounding_volume = beyond(BoundingVolume::oriented);
    expect_refused(settings, "Settings::bounding_volume is no enumerator: 2");
    settings = {};
    settings.batches_in_flight = max_batches_in_flight + 1;
    expect_refused(settings, "batches_in_flight is 9");
}

TEST_F(BadStructures, QueriesWithNumbersThatAreNoEnumerators) {
    Expected<Context> context = Context::create(driver_.host());
    ASSERT_TRUE(context.has_value()) << context.error().text();
    const Expected<ShapeHandle> shape = context->add_shape({{{{0, 0}, {1, 0}, {0, 1}}}});
    ASSERT_TRUE(shape.has_value());
    const Instance here{*shape, {}};
    driver_.forget_calls();
    // `bend` makes one change that invalidates an otherwise valid query.
    const auto try_query = [&](auto query, const auto& bend, const std::string& words) {
        query.a = query.b = here;
        query.tolerance = 0.1;
        for (const Technique technique : any_technique) {
            query.technique = technique;
            bend(query);
            Batch batch;
            const auto handle = batch.add(query);
            Results results;
            const Status status = context->run(batch, results);
            EXPECT_TRUE(status.ok()) << status.text();
            expect_refused(results[handle].status, StatusCode::invalid_query, words);
        }
    };
    try_query(
        PenetrationQuery{}, [](auto& query) { query.points = beyond(PenetrationPoints::vertices); },
        "the points are no enumerator: 2");
    try_query(
        PenetrationQuery{}, [](auto& query) { query.technique = beyond(Technique::cpu); },
        "the technique is no enumerator: 4");
    try_query(
        IntersectionQuery{},
        [](auto& query) { query.kind = beyond(IntersectionKind::volume_volume); },
        "the kind is no enumerator: 3");
    try_query(
        IntersectionQuery{},
        [](auto& query) { query.strategy = beyond(IntersectionStrategy::depth); },
        "the strategy is no enumerator: 4");
    try_query(
        DistanceFieldQuery{}, [](auto& query) { query.sign = beyond(SignEncoding::feature_bit); },
        "the sign encoding is no enumerator: 3");
    try_query(
        DistanceFieldQuery{}, [](auto& query) { query.gradient = beyond(GradientMethod::blended); },
        "the gradient method is no enumerator: 3");
    try_query(
        ContactQuery{},
        [](auto& query) {
            query.contact_distance = 0.1;
            query.normals = beyond(ContactNormals::gradient);
        },
        "the normals are no enumerator: 2");
    expect_refused(describe_graph(*context, beyond(GraphFormat::graphviz)).error(),
                   StatusCode::invalid_settings, "no enumerator: 2");
}

#ifndef NEARFIELD_SHADER_RELOAD
TEST_F(BadStructures, ShadersToReloadWhereTheLibraryWasBuiltWithoutThat) {
    Expected<Context> context = Context::create(driver_.host());
    ASSERT_TRUE(context.has_value()) << context.error().text();
    driver_.forget_calls();
    expect_refused(reload_shaders(*context).error(), StatusCode::unavailable,
                   "NEARFIELD_SHADER_RELOAD");
}
#endif

}  // namespace
}  // namespace nearfield::test
