#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/requirements.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/fixture.hpp>
#include <tests/unit/gpu/requirements.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield {
namespace {

using test_support::blends;
using test_support::FakeLoader;
using test_support::Lies;
using test_support::physical;
using test_support::requirements_of;
using test_support::without;

class GpuRequirements : public test_support::GpuTest {};

Status status_of(const HostDevice& host) {
    try {
        const gpu::Device device(host);
        return {};
    } catch (const StatusException& failure) {
        return failure.status();
    }
}

Status status_with(const HostDevice& host, Lies lies) {
    const FakeLoader fake(host, std::move(lies));
    return status_of(fake.host());
}

void expect_one_reason(const Status& status, const std::vector<std::string>& words) {
    ASSERT_EQ(status.code(), StatusCode::unsupported_device) << status.text();
    ASSERT_EQ(status.reasons().size(), 1U) << status.text();
    for (const std::string& word : words) {
        EXPECT_NE(status.reasons()[0].find(word), std::string::npos)
            << "'" << word << "' in: " << status.reasons()[0];
    }
}

TEST_F(GpuRequirements, BareDeviceSuffices) {
    const HostDevice& host = host_.device();
    EXPECT_EQ(requirements_of(host).unmet, std::vector<std::string>{});
    const gpu::Device device(host);
    EXPECT_FALSE(device.name().empty());
    EXPECT_NE(device.stencil_format(), VK_FORMAT_UNDEFINED);
    EXPECT_EQ(device.queue(), host.queue);
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
    EXPECT_EQ(gpu::Device(host_.device()).gradient_format(),
              blends(host_.device(), VK_FORMAT_R32G32_SFLOAT) ? VK_FORMAT_R32G32_SFLOAT
                                                              : VK_FORMAT_R16G16_SFLOAT);
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
        {"maxPerStageDescriptorStorageImages",
         &VkPhysicalDeviceLimits::maxPerStageDescriptorStorageImages, 2},
        {"maxComputeWorkGroupInvocations", &VkPhysicalDeviceLimits::maxComputeWorkGroupInvocations,
         128},
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

/// Takes a capability from all queue families.
Lies without_flag(VkQueueFlags flag) {
    Lies lies;
    lies.queue_families = [flag](std::vector<VkQueueFamilyProperties>& families) {
        for (VkQueueFamilyProperties& family : families) {
            family.queueFlags &= ~flag;
        }
    };
    return lies;
}

TEST_F(GpuRequirements, QueueFamilyMustCompute) {
    expect_one_reason(status_with(host_.device(), without_flag(VK_QUEUE_COMPUTE_BIT)),
                      {"VK_QUEUE_COMPUTE_BIT", "queue family"});
    HostDevice host = host_.device();
    host.queue_family = 99;
    expect_one_reason(status_of(host), {"queue family 99"});
}

TEST_F(GpuRequirements, QueueFamilyThatDoesNotDrawSufficesForComputing) {
    EXPECT_TRUE(gpu::Device(host_.device()).draws());
    const FakeLoader fake(host_.device(), without_flag(VK_QUEUE_GRAPHICS_BIT));
    const gpu::Device device(fake.host());
    EXPECT_FALSE(device.draws());
    const Requirements found = requirements_of(fake.host());
    EXPECT_TRUE(found.met());
    EXPECT_EQ(found.queue_flags, VkQueueFlags{VK_QUEUE_COMPUTE_BIT});
    EXPECT_EQ(found.queue_family, fake.host().queue_family);
    const OptionalPart* const raster = found.find("VK_QUEUE_GRAPHICS_BIT");
    ASSERT_NE(raster, nullptr);
    EXPECT_FALSE(raster->available);
    ASSERT_EQ(raster->missing.size(), 1U);
    EXPECT_NE(raster->missing[0].find("queue family " + std::to_string(fake.host().queue_family) +
                                      " lacks it"),
              std::string::npos)
        << raster->missing[0];
    EXPECT_NE(std::string(raster->unlocks).find("Technique::raster"), std::string::npos);
}

TEST_F(GpuRequirements, FamiliesThatShareResidentResultsMustExist) {
    const std::uint32_t own = host_.device().queue_family;
    const std::uint32_t families[] = {own, own, 7};
    HostDevice host = host_.device();
    host.reader_families = families;
    host.reader_family_count = 2;
    EXPECT_TRUE(gpu::Device(host).reader_families().empty()) << "one family shares with none";
    host.reader_family_count = 3;
    const Status status = status_of(host);
    EXPECT_EQ(status.code(), StatusCode::invalid_settings);
    EXPECT_NE(status.message().find("HostDevice::reader_families[2] is 7"), std::string::npos)
        << status.message();
    Lies lies;
    lies.queue_families = [](std::vector<VkQueueFamilyProperties>& all) {
        all.resize(8, all.front());
    };
    const FakeLoader fake(host, lies);
    EXPECT_EQ(gpu::Device(fake.host()).reader_families(), (std::vector<std::uint32_t>{own, 7}));
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
    EXPECT_EQ(found.limits.size(), 4U);
    EXPECT_EQ(found.formats.size(), 11U);
}

TEST_F(GpuRequirements, NameAQueueFamilyWhereNoneIsGiven) {
    Lies lies;
    lies.queue_families = [](std::vector<VkQueueFamilyProperties>& families) {
        VkQueueFamilyProperties transfer = families.front();
        transfer.queueFlags = VK_QUEUE_TRANSFER_BIT;
        VkQueueFamilyProperties compute = families.front();
        compute.queueFlags = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
        families.insert(families.begin(), {transfer, compute});
    };
    const FakeLoader fake(host_.device(), lies);
    PhysicalDevice device = physical(fake.host());
    device.queue_family = PhysicalDevice::any_queue_family;
    EXPECT_EQ(requirements_of(device).queue_family, 2U);
    device.queue_family = 1;
    EXPECT_EQ(requirements_of(device).queue_family, 1U);
    device.queue_family = 0;
    const Requirements found = requirements_of(device);
    EXPECT_FALSE(found.queue_family.has_value());
    EXPECT_EQ(found.unmet.size(), 1U);
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
          +[](PhysicalDevice& device) { device.get_instance_proc_addr = nullptr; }}) {
        PhysicalDevice device = physical(host_.device());
        clear(device);
        EXPECT_EQ(requirements(device).error().code(), StatusCode::invalid_settings);
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

}  // namespace
}  // namespace nearfield
