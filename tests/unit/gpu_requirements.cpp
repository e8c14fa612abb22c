#include <engine/failure.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/requirements.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu_fixture.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield {
namespace {

using test_support::FakeLoader;
using test_support::Lies;

class GpuRequirements : public test_support::GpuTest {};

Status status_of(const HostDevice& host) {
    try {
        const gpu::Device device(host);
        return {};
    } catch (const Failure& failure) {
        return failure.status();
    }
}

Status status_with(const HostDevice& host, Lies lies) {
    const FakeLoader fake(host, std::move(lies));
    return status_of(fake.host());
}

PhysicalDevice physical(const HostDevice& host) {
    PhysicalDevice device;
    device.queue_family = host.queue_family;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.get_instance_proc_addr = host.get_instance_proc_addr;
    device.debug_utils = host.debug_utils;
    return device;
}

Requirements requirements_of(const PhysicalDevice& device) {
    const Expected<Requirements> found = requirements(device);
    EXPECT_TRUE(found.ok()) << found.status().text();
    return found.ok() ? *found : Requirements{};
}

Requirements requirements_of(const HostDevice& host) {
    return requirements_of(physical(host));
}

void expect_one_reason(const Status& status, const std::vector<std::string>& words) {
    ASSERT_EQ(status.code(), StatusCode::unsupported_device) << status.text();
    ASSERT_EQ(status.reasons().size(), 1U) << status.text();
    for (const std::string& word : words) {
        EXPECT_NE(status.reasons()[0].find(word), std::string::npos)
            << "'" << word << "' in: " << status.reasons()[0];
    }
}

Lies without(VkFormat format, VkFormatFeatureFlags features) {
    Lies lies;
    lies.format = [=](VkFormat asked, VkFormatProperties& properties) {
        if (asked == format) {
            properties.optimalTilingFeatures &= ~features;
        }
    };
    return lies;
}

TEST_F(GpuRequirements, BareDeviceSuffices) {
    const HostDevice& host = host_.device();
    EXPECT_EQ(requirements_of(host).unmet, std::vector<std::string>{});
    const gpu::Device device(host);
    EXPECT_FALSE(device.name().empty());
    EXPECT_NE(device.stencil_format(), VK_FORMAT_UNDEFINED);
    EXPECT_EQ(device.queue(), host.queue);
}

TEST_F(GpuRequirements, TruthThroughTheFakeLoaderSuffices) {
    EXPECT_TRUE(status_with(host_.device(), {}).ok());
}

TEST_F(GpuRequirements, EachMissingFormatFeatureIsNamed) {
    struct Case {
        VkFormat format;
        VkFormatFeatureFlags feature;
        const char* format_name;
        const char* feature_name;
    };
    const std::vector<Case> cases{
        {VK_FORMAT_R32_UINT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "VK_FORMAT_R32_UINT",
         "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT"},
        {VK_FORMAT_R32_UINT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "VK_FORMAT_R32_UINT",
         "VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT"},
        {VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
         "VK_FORMAT_D32_SFLOAT", "VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT"},
    };
    for (const Case& missing : cases) {
        SCOPED_TRACE(std::string(missing.format_name) + " " + missing.feature_name);
        expect_one_reason(status_with(host_.device(), without(missing.format, missing.feature)),
                          {std::string(missing.format_name) + ":", missing.feature_name});
    }
}

TEST_F(GpuRequirements, GradientFallsBackToHalfPrecision) {
    constexpr VkFormatFeatureFlags blend = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    EXPECT_EQ(gpu::Device(host_.device()).gradient_format(), VK_FORMAT_R32G32_SFLOAT);
    const FakeLoader half(host_.device(), without(VK_FORMAT_R32G32_SFLOAT, blend));
    EXPECT_EQ(gpu::Device(half.host()).gradient_format(), VK_FORMAT_R16G16_SFLOAT);
}

TEST_F(GpuRequirements, SomethingHasToBlendGradients) {
    Lies lies;
    lies.format = [](VkFormat format, VkFormatProperties& properties) {
        if (format == VK_FORMAT_R32G32_SFLOAT || format == VK_FORMAT_R16G16_SFLOAT) {
            properties.optimalTilingFeatures &=
                ~static_cast<VkFormatFeatureFlags>(VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
        }
    };
    expect_one_reason(status_with(host_.device(), std::move(lies)),
                      {"gradient format", "VK_FORMAT_R16G16_SFLOAT"});
}

TEST_F(GpuRequirements, StencilFallsBackToTheOtherCombinedFormat) {
    for (const bool has_d32 : {false, true}) {
        for (const bool has_d24 : {false, true}) {
            SCOPED_TRACE(std::to_string(has_d32) + std::to_string(has_d24));
            Lies lies;
            lies.format = [=](VkFormat format, VkFormatProperties& properties) {
                const VkFormatFeatureFlags attachment =
                    VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
                if (format == VK_FORMAT_D32_SFLOAT_S8_UINT) {
                    properties.optimalTilingFeatures = has_d32 ? attachment : 0;
                } else if (format == VK_FORMAT_D24_UNORM_S8_UINT) {
                    properties.optimalTilingFeatures = has_d24 ? attachment : 0;
                }
            };
            const FakeLoader fake(host_.device(), lies);
            if (has_d32 || has_d24) {
                EXPECT_EQ(gpu::Device(fake.host()).stencil_format(),
                          has_d32 ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_D24_UNORM_S8_UINT);
            } else {
                expect_one_reason(status_of(fake.host()),
                                  {"VK_FORMAT_D32_SFLOAT_S8_UINT", "VK_FORMAT_D24_UNORM_S8_UINT"});
            }
        }
    }
}

TEST_F(GpuRequirements, EachMissingLimitIsNamedAndTheLeastIsEnough) {
    struct Case {
        const char* name;
        std::uint32_t VkPhysicalDeviceLimits::*limit;
        std::uint32_t needed;
    };
    const std::vector<Case> cases{
        {"subPixelPrecisionBits", &VkPhysicalDeviceLimits::subPixelPrecisionBits, 4},
        {"maxPerStageDescriptorStorageBuffers",
         &VkPhysicalDeviceLimits::maxPerStageDescriptorStorageBuffers, 4},
        {"maxComputeWorkGroupInvocations", &VkPhysicalDeviceLimits::maxComputeWorkGroupInvocations,
         64},
    };
    for (const Case& limit : cases) {
        SCOPED_TRACE(limit.name);
        for (const std::uint32_t offered : {limit.needed - 1, limit.needed}) {
            Lies lies;
            lies.properties = [&](VkPhysicalDeviceProperties& properties) {
                properties.limits.*limit.limit = offered;
            };
            const Status status = status_with(host_.device(), lies);
            if (offered < limit.needed) {
                expect_one_reason(status, {limit.name, std::to_string(offered)});
            } else {
                EXPECT_TRUE(status.ok()) << status.text();
            }
        }
    }
}

TEST_F(GpuRequirements, OldVulkanIsRefused) {
    Lies lies;
    lies.properties = [](VkPhysicalDeviceProperties& properties) {
        properties.apiVersion = VK_MAKE_API_VERSION(0, 1, 0, 999);
    };
    expect_one_reason(status_with(host_.device(), lies), {"Vulkan 1.1", "1.0"});
}

TEST_F(GpuRequirements, QueueFamilyMustDrawAndCompute) {
    for (const auto& [flag, name] : {std::pair{VK_QUEUE_GRAPHICS_BIT, "VK_QUEUE_GRAPHICS_BIT"},
                                     std::pair{VK_QUEUE_COMPUTE_BIT, "VK_QUEUE_COMPUTE_BIT"}}) {
        SCOPED_TRACE(name);
        Lies lies;
        lies.queue_families = [flag = flag](std::vector<VkQueueFamilyProperties>& families) {
            for (VkQueueFamilyProperties& family : families) {
                family.queueFlags &= ~static_cast<VkQueueFlags>(flag);
            }
        };
        expect_one_reason(status_with(host_.device(), lies), {name, "queue family"});
    }
    HostDevice host = host_.device();
    host.queue_family = 99;
    expect_one_reason(status_of(host), {"queue family 99"});
}

TEST_F(GpuRequirements, EveryMissingEntryPointIsNamed) {
    const std::vector<const char*> names{
#define NEARFIELD_NAME(name) #name,
        NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_NAME) NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_NAME)
            NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_NAME)
#undef NEARFIELD_NAME
    };
    for (const char* name : names) {
        SCOPED_TRACE(name);
        Lies lies;
        lies.entry_points[name] = nullptr;
        expect_one_reason(status_with(host_.device(), lies),
                          {std::string("entry point ") + name + ":"});
    }
}

TEST_F(GpuRequirements, MissingRequirementsNamesMissingEntryPoints) {
    Lies lies;
    lies.entry_points["vkGetPhysicalDeviceFormatProperties"] = nullptr;
    const FakeLoader fake(host_.device(), lies);
    const std::vector<std::string> missing = requirements_of(fake.host()).unmet;
    ASSERT_EQ(missing.size(), 1U);
    EXPECT_NE(missing[0].find("vkGetPhysicalDeviceFormatProperties"), std::string::npos);
}

TEST_F(GpuRequirements, AreAskedForWithNothingCreated) {
    static std::vector<std::string> asked;
    asked.clear();
    PhysicalDevice device = physical(host_.device());
    static PFN_vkGetInstanceProcAddr truth;
    truth = device.get_instance_proc_addr;
    device.get_instance_proc_addr = [](VkInstance instance, const char* name) {
        asked.emplace_back(name);
        return truth(instance, name);
    };
    const Requirements found = requirements_of(device);
    EXPECT_TRUE(found.met());
    EXPECT_FALSE(asked.empty());
    for (const std::string& name : asked) {
        EXPECT_TRUE(name.starts_with("vkGet") || name.starts_with("vkEnumerate")) << name;
    }
    EXPECT_EQ(found.queue_family, device.queue_family);
    EXPECT_EQ(found.limits.size(), 3U);
    EXPECT_EQ(found.formats.size(), 9U);
}

TEST_F(GpuRequirements, NameAQueueFamilyWhereNoneIsGiven) {
    Lies lies;
    lies.queue_families = [](std::vector<VkQueueFamilyProperties>& families) {
        VkQueueFamilyProperties transfer = families.front();
        transfer.queueFlags = VK_QUEUE_TRANSFER_BIT;
        families.insert(families.begin(), {transfer, transfer});
    };
    const FakeLoader fake(host_.device(), lies);
    PhysicalDevice device = physical(fake.host());
    device.queue_family = PhysicalDevice::any_queue_family;
    EXPECT_EQ(requirements_of(device).queue_family, 2U);
    device.queue_family = 1;
    const Requirements found = requirements_of(device);
    EXPECT_FALSE(found.queue_family.has_value());
    EXPECT_EQ(found.unmet.size(), 2U);
}

TEST_F(GpuRequirements, OptionalPartsSayWhatTheyUnlockAndWhatIsMissing) {
    const Requirements all = requirements_of(host_.device());
    for (const OptionalPart& part : all.optional) {
        SCOPED_TRACE(part.name);
        EXPECT_EQ(part.available, part.missing.empty());
        EXPECT_NE(std::string(part.unlocks), "");
        EXPECT_EQ(all.find(part.name), &part);
    }
    EXPECT_EQ(all.find("no such part"), nullptr);
    // lavapipe has all of it, once the host says what it enabled on the instance.
    ASSERT_EQ(all.optional.size(), 6U);
    EXPECT_EQ(all.features.logicOp, VK_TRUE);
    EXPECT_EQ(all.timeline_semaphore.timelineSemaphore, VK_TRUE);
    ASSERT_EQ(all.device_extensions.size(), 1U);
    EXPECT_EQ(std::string(all.device_extensions[0]), "VK_KHR_timeline_semaphore");
    PhysicalDevice newer = physical(host_.device());
    newer.api_version = VK_API_VERSION_1_2;
    EXPECT_TRUE(requirements_of(newer).device_extensions.empty());
    EXPECT_EQ(requirements_of(newer).timeline_semaphore.timelineSemaphore, VK_TRUE);

    const auto missing = [&](const char* name, Lies lies) {
        const FakeLoader fake(host_.device(), std::move(lies));
        const Requirements found = requirements_of(fake.host());
        EXPECT_TRUE(found.met());
        const OptionalPart* const part = found.find(name);
        return part == nullptr || part->missing.empty() ? std::string() : part->missing.front();
    };
    EXPECT_EQ(missing("logicOp", {}), "");
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
    EXPECT_EQ(missing("timelineSemaphore", core_name_only), "");
    Lies neither = core_name_only;
    neither.entry_points["vkGetPhysicalDeviceFeatures2"] = nullptr;
    EXPECT_NE(missing("timelineSemaphore", neither).find("vkGetPhysicalDeviceFeatures2KHR"),
              std::string::npos);
    Lies no_extensions = {};
    no_extensions.entry_points["vkEnumerateDeviceExtensionProperties"] = nullptr;
    EXPECT_NE(missing("timelineSemaphore", no_extensions).find("VK_KHR_timeline_semaphore"),
              std::string::npos);
    HostDevice quiet = host_.device();
    quiet.debug_utils = false;
    EXPECT_FALSE(requirements_of(quiet).find("VK_EXT_debug_utils")->available);
}

TEST_F(GpuRequirements, TheAliasDoesWhereTheCoreNameIsMissing) {
    // An instance for 1.0 with VK_KHR_get_physical_device_properties2 has the alias alone.
    static PFN_vkVoidFunction alias;
    alias = host_.device().get_instance_proc_addr(host_.device().instance,
                                                  "vkGetPhysicalDeviceFeatures2");
    Lies lies;
    lies.entry_points["vkGetPhysicalDeviceFeatures2"] = nullptr;
    lies.entry_points["vkGetPhysicalDeviceFeatures2KHR"] = alias;
    const FakeLoader fake(host_.device(), lies);
    EXPECT_TRUE(requirements_of(fake.host()).find("timelineSemaphore")->available);
}

TEST_F(GpuRequirements, OfAnInstanceForVulkan10AreUnmet) {
    PhysicalDevice device = physical(host_.device());
    device.api_version = VK_API_VERSION_1_0;
    const Requirements found = requirements_of(device);
    ASSERT_EQ(found.unmet.size(), 1U);
    EXPECT_NE(found.unmet[0].find("api_version"), std::string::npos) << found.unmet[0];
    HostDevice host = host_.device();
    host.api_version = VK_API_VERSION_1_0;
    expect_one_reason(status_of(host), {"Vulkan 1.1", "api_version"});
}

TEST_F(GpuRequirements, OfNothingAreRefused) {
    for (const auto clear :
         {+[](PhysicalDevice& device) { device.instance = VK_NULL_HANDLE; },
          +[](PhysicalDevice& device) { device.physical_device = VK_NULL_HANDLE; },
          +[](PhysicalDevice& device) { device.get_instance_proc_addr = nullptr; },
          +[](PhysicalDevice& device) { device.structure_size = 4; }}) {
        PhysicalDevice device = physical(host_.device());
        clear(device);
        EXPECT_EQ(requirements(device).status().code(), StatusCode::invalid_settings);
    }
}

TEST_F(GpuRequirements, DebugFunctionsAreNotAskedForWithoutDebugUtils) {
    Lies lies;
    lies.entry_points["vkSetDebugUtilsObjectNameEXT"] = nullptr;
    const FakeLoader fake(host_.device(), lies);
    HostDevice host = fake.host();
    host.debug_utils = false;
    EXPECT_TRUE(status_of(host).ok());
}

TEST_F(GpuRequirements, EveryLackIsReportedAtOnce) {
    Lies lies = without(VK_FORMAT_R32_UINT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT |
                                                VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT);
    lies.properties = [](VkPhysicalDeviceProperties& properties) {
        properties.limits.subPixelPrecisionBits = 0;
    };
    lies.entry_points["vkCmdDraw"] = nullptr;
    const Status status = status_with(host_.device(), lies);
    EXPECT_EQ(status.code(), StatusCode::unsupported_device);
    EXPECT_EQ(status.reasons().size(), 4U) << status.text();
}

TEST_F(GpuRequirements, NullHandlesAreNamed) {
    const std::vector<std::pair<const char*, std::function<void(HostDevice&)>>> cases{
        {"instance", [](HostDevice& host) { host.instance = VK_NULL_HANDLE; }},
        {"physical_device", [](HostDevice& host) { host.physical_device = VK_NULL_HANDLE; }},
        {"::device", [](HostDevice& host) { host.device = VK_NULL_HANDLE; }},
        {"queue", [](HostDevice& host) { host.queue = VK_NULL_HANDLE; }},
        {"get_instance_proc_addr", [](HostDevice& host) { host.get_instance_proc_addr = nullptr; }},
    };
    for (const auto& [name, clear] : cases) {
        SCOPED_TRACE(name);
        HostDevice host = host_.device();
        clear(host);
        expect_one_reason(status_of(host), {name});
    }
    EXPECT_EQ(status_of(HostDevice{}).reasons().size(), cases.size());
}

TEST_F(GpuRequirements, EachStrategyNamesWhatItLacks) {
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

TEST_F(GpuRequirements, ADeviceHasTheFeatureThatItsHostSaysAndNoOther) {
    HostDevice host = host_.device();
    EXPECT_FALSE(gpu::Device(host).strategy_support().logic_op);
    host.logic_op = true;
    EXPECT_TRUE(gpu::Device(host).strategy_support().logic_op);
}

// The base asks for that format's blending too, for the sign in the top bit of an id, so no device
// gets here without it; what strategies need is nevertheless said in one place, for all of them.
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
