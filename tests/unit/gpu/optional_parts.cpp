#include <engine/gpu/device.hpp>
#include <engine/gpu/strategies.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/fixture.hpp>
#include <tests/unit/gpu/requirements.hpp>

#include <string>

namespace nearfield {
namespace {

using test_support::blends;
using test_support::FakeLoader;
using test_support::Lies;
using test_support::physical;
using test_support::requirements_of;
using test_support::without;

/// Parts of a device that are not required but used if the host enabled them.
class GpuOptionalParts : public test_support::GpuTest {};

TEST_F(GpuOptionalParts, AreThoseThatTheDriverOffers) {
    const Requirements all = requirements_of(host_.device());
    for (const OptionalPart& part : all.optional) {
        SCOPED_TRACE(part.name);
        EXPECT_EQ(part.available, part.missing.empty());
        EXPECT_NE(std::string(part.unlocks), "");
        EXPECT_EQ(all.find(part.name), &part);
    }
    EXPECT_EQ(all.find("no such part"), nullptr);
    // The driver's parts, after the host reports those enabled on the instance.
    const test_support::Enabled offered = host_.offered();
    ASSERT_EQ(all.optional.size(), 7U);
    EXPECT_TRUE(all.find("VK_QUEUE_GRAPHICS_BIT")->available);
    EXPECT_EQ(all.features.logicOp, offered.features.logicOp);
    EXPECT_EQ(all.find("logicOp")->available, offered.features.logicOp == VK_TRUE);
    EXPECT_EQ(all.find("blending of VK_FORMAT_R32G32_SFLOAT")->available,
              blends(host_.device(), VK_FORMAT_R32G32_SFLOAT));
    EXPECT_EQ(all.timeline_semaphore.timelineSemaphore == VK_TRUE, offered.timeline_semaphore);
    ASSERT_EQ(all.device_extensions.size(), offered.timeline_semaphore ? 1U : 0U);
    for (const char* const extension : all.device_extensions) {
        EXPECT_EQ(std::string(extension), "VK_KHR_timeline_semaphore");
    }
    PhysicalDevice newer = physical(host_.device());
    newer.api_version = VK_API_VERSION_1_2;
    EXPECT_TRUE(requirements_of(newer).device_extensions.empty());
    EXPECT_EQ(requirements_of(newer).timeline_semaphore.timelineSemaphore,
              all.timeline_semaphore.timelineSemaphore);
}

TEST_F(GpuOptionalParts, SayWhatIsMissing) {
    const test_support::Enabled offered = host_.offered();
    const auto missing = [&](const char* name, Lies lies) {
        const FakeLoader fake(host_.device(), std::move(lies));
        const Requirements found = requirements_of(fake.host());
        EXPECT_TRUE(found.met());
        const OptionalPart* const part = found.find(name);
        return part == nullptr || part->missing.empty() ? std::string() : part->missing.front();
    };
    if (offered.features.logicOp == VK_TRUE) {
        EXPECT_EQ(missing("logicOp", {}), "");
    } else {
        EXPECT_EQ(missing("logicOp", {}).find("feature logicOp: "), 0U);
    }
    Lies no_timestamps;
    no_timestamps.queue_families = [](std::vector<VkQueueFamilyProperties>& families) {
        families.front().timestampValidBits = 0;
    };
    EXPECT_NE(missing("timestamps", no_timestamps).find("timestampValidBits"), std::string::npos);
    EXPECT_NE(
        missing("blending of VK_FORMAT_R32G32_SFLOAT",
                without(VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
            .find("VK_FORMAT_R16G16_SFLOAT"),
        std::string::npos);
    Lies no_features;
    no_features.entry_points["vkGetPhysicalDeviceFeatures"] = nullptr;
    EXPECT_NE(missing("logicOp", no_features).find("feature logicOp"), std::string::npos);
    Lies core_name_only;
    core_name_only.entry_points["vkGetPhysicalDeviceFeatures2KHR"] = nullptr;
    EXPECT_EQ(missing("timelineSemaphore", core_name_only).empty(), offered.timeline_semaphore);
    Lies neither = core_name_only;
    neither.entry_points["vkGetPhysicalDeviceFeatures2"] = nullptr;
    if (offered.timeline_semaphore) {
        EXPECT_NE(missing("timelineSemaphore", neither).find("vkGetPhysicalDeviceFeatures2KHR"),
                  std::string::npos);
    }
    Lies no_extensions = {};
    no_extensions.entry_points["vkEnumerateDeviceExtensionProperties"] = nullptr;
    EXPECT_NE(missing("timelineSemaphore", no_extensions).find("VK_KHR_timeline_semaphore"),
              std::string::npos);
    HostDevice quiet = host_.device();
    quiet.debug_utils = false;
    EXPECT_FALSE(requirements_of(quiet).find("VK_EXT_debug_utils")->available);
}

TEST_F(GpuOptionalParts, TheAliasDoesWhereTheCoreNameIsMissing) {
    // A Vulkan 1.0 instance with VK_KHR_get_physical_device_properties2 has only the alias.
    static PFN_vkVoidFunction alias;
    alias = host_.device().get_instance_proc_addr(host_.device().instance,
                                                  "vkGetPhysicalDeviceFeatures2");
    Lies lies;
    lies.entry_points["vkGetPhysicalDeviceFeatures2"] = nullptr;
    lies.entry_points["vkGetPhysicalDeviceFeatures2KHR"] = alias;
    const FakeLoader fake(host_.device(), lies);
    EXPECT_EQ(requirements_of(fake.host()).find("timelineSemaphore")->available,
              host_.offered().timeline_semaphore);
}

TEST_F(GpuOptionalParts, EachStrategyNamesWhatItLacks) {
    using S = IntersectionStrategy;
    const gpu::StrategySupport nothing{};
    for (const S strategy : {S::stencil, S::depth}) {
        EXPECT_TRUE(gpu::missing_for(strategy, nothing).empty());
    }
    EXPECT_EQ(gpu::missing_for(S::blend, nothing).size(), 3U);
    for (const std::string& reason : gpu::missing_for(S::blend, nothing)) {
        EXPECT_EQ(reason.find("format VK_FORMAT_R8G8B8A8_UNORM: "), 0U) << reason;
    }
    ASSERT_EQ(gpu::missing_for(S::logic_op, nothing).size(), 1U);
    EXPECT_EQ(gpu::missing_for(S::logic_op, nothing)[0].find("feature logicOp: "), 0U);
    EXPECT_TRUE(gpu::missing_for(S::logic_op, {true, 0}).empty());
}

TEST_F(GpuOptionalParts, ADeviceHasTheFeatureThatItsHostSaysAndNoOther) {
    HostDevice host = host_.device();
    EXPECT_FALSE(gpu::Device(host).strategy_support().logic_op);
    host.logic_op = true;
    EXPECT_TRUE(gpu::Device(host).strategy_support().logic_op);
}

// The base also requires blending for that format, for the sign in the top bit of an id, so every
// accepted device has it; the requirements of all strategies are nevertheless stated in one place.
TEST(Strategies, AFormatThatDoesNotBlendCostsOneStrategyOnly) {
    const gpu::StrategySupport support{
        true, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT};
    const auto missing = gpu::missing_for(IntersectionStrategy::blend, support);
    ASSERT_EQ(missing.size(), 1U);
    EXPECT_NE(missing[0].find("VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT"), std::string::npos);
    for (const auto strategy : {IntersectionStrategy::stencil, IntersectionStrategy::logic_op,
                                IntersectionStrategy::depth}) {
        EXPECT_TRUE(gpu::missing_for(strategy, support).empty());
    }
}

}  // namespace
}  // namespace nearfield
