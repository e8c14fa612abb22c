#include <engine/gpu/requirements.hpp>

#include <array>

namespace nearfield::gpu {
namespace {

using Reasons = std::vector<std::string>;

struct InstanceFunctions {
    PFN_vkGetPhysicalDeviceProperties properties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties queue_families = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties format = nullptr;
};

template <class Function>
void load(PFN_vkGetInstanceProcAddr get, VkInstance instance, const char* name, Function& function,
          Reasons& missing) {
    function = reinterpret_cast<Function>(get(instance, name));
    if (function == nullptr) {
        missing.push_back(std::string("entry point ") + name +
                          ": vkGetInstanceProcAddr does not know it");
    }
}

void check_version(const VkPhysicalDeviceProperties& properties, Reasons& missing) {
    if (properties.apiVersion < VK_API_VERSION_1_1) {
        missing.push_back("Vulkan 1.1: the device offers Vulkan " +
                          std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
                          std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) +
                          " only, and shaders are SPIR-V 1.3");
    }
}

void check_queue_family(const InstanceFunctions& functions, VkPhysicalDevice device,
                        std::uint32_t queue_family, Reasons& missing) {
    std::uint32_t count = 0;
    functions.queue_families(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    functions.queue_families(device, &count, families.data());
    const std::string name = "queue family " + std::to_string(queue_family);
    if (queue_family >= count) {
        missing.push_back(name + ": the device has " + std::to_string(count) + " queue families");
        return;
    }
    const VkQueueFlags flags = families[queue_family].queueFlags;
    const std::string reason = ": " + name + " lacks it, and one queue has to draw and compute";
    if ((flags & VK_QUEUE_GRAPHICS_BIT) == 0) {
        missing.push_back("VK_QUEUE_GRAPHICS_BIT" + reason);
    }
    if ((flags & VK_QUEUE_COMPUTE_BIT) == 0) {
        missing.push_back("VK_QUEUE_COMPUTE_BIT" + reason);
    }
}

void check_limits(const VkPhysicalDeviceLimits& limits, Reasons& missing) {
    struct Limit {
        const char* name;
        std::uint32_t offered;
        std::uint32_t needed;
        const char* why;
    };
    // All are minima of the specification; a device below them could not be trusted with the rest.
    const std::array<Limit, 3> table{{
        {"subPixelPrecisionBits", limits.subPixelPrecisionBits, 4,
         "vertices are snapped to the sub-pixel grid"},
        {"maxPerStageDescriptorStorageBuffers", limits.maxPerStageDescriptorStorageBuffers, 4,
         "a compute pass uses as many storage buffers"},
        {"maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations, 64,
         "compute passes work in groups of 8 by 8"},
    }};
    for (const Limit& limit : table) {
        if (limit.offered < limit.needed) {
            missing.push_back(std::string("limit ") + limit.name + ": the device offers " +
                              std::to_string(limit.offered) + ", at least " +
                              std::to_string(limit.needed) + " needed because " + limit.why);
        }
    }
}

VkFormatFeatureFlags optimal_features(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                      VkPhysicalDevice device, VkFormat format) {
    VkFormatProperties properties{};
    get_properties(device, format, &properties);
    return properties.optimalTilingFeatures;
}

void check_formats(const InstanceFunctions& functions, VkPhysicalDevice device, Reasons& missing) {
    struct Requirement {
        VkFormat format;
        const char* format_name;
        VkFormatFeatureFlags feature;
        const char* feature_name;
        const char* why;
    };
    const std::array<Requirement, 5> table{{
        {VK_FORMAT_R32_UINT, "VK_FORMAT_R32_UINT", VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
         "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT", "signs and feature ids are drawn to it"},
        {VK_FORMAT_R32_UINT, "VK_FORMAT_R32_UINT", VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT,
         "VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT", "signs and feature ids are read by compute passes"},
        {VK_FORMAT_D32_SFLOAT, "VK_FORMAT_D32_SFLOAT",
         VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
         "VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT", "the nearest feature wins by depth"},
        {VK_FORMAT_R8_UNORM, "VK_FORMAT_R8_UNORM", VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
         "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT", "signs are drawn white on black to it"},
        {VK_FORMAT_R8G8B8A8_UNORM, "VK_FORMAT_R8G8B8A8_UNORM",
         VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
         "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT",
         "signs are drawn as the top bit of feature ids to it"},
    }};
    for (const Requirement& row : table) {
        if ((optimal_features(functions.format, device, row.format) & row.feature) == 0) {
            missing.push_back(std::string("format ") + row.format_name + ": optimal tiling lacks " +
                              row.feature_name + ", and " + row.why);
        }
    }
    if (find_stencil_format(functions.format, device) == VK_FORMAT_UNDEFINED) {
        missing.emplace_back(
            "a stencil format: neither VK_FORMAT_D32_SFLOAT_S8_UINT nor "
            "VK_FORMAT_D24_UNORM_S8_UINT has VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT with "
            "optimal tiling, and shapes are filled by stencil parity");
    }
    if (find_gradient_format(functions.format, device) == VK_FORMAT_UNDEFINED) {
        missing.emplace_back(
            "a gradient format: neither VK_FORMAT_R32G32_SFLOAT nor VK_FORMAT_R16G16_SFLOAT has "
            "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT and VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT "
            "with optimal tiling, and gradients are blended in it");
    }
}

}  // namespace

VkFormat find_stencil_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                             VkPhysicalDevice physical_device) {
    // Every device has at least one of the two.
    for (const VkFormat format : {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT}) {
        if ((optimal_features(get_properties, physical_device, format) &
             VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0) {
            return format;
        }
    }
    return VK_FORMAT_UNDEFINED;
}

VkFormat find_gradient_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                              VkPhysicalDevice physical_device) {
    constexpr VkFormatFeatureFlags needed =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    // Every device blends the second; few leave the first out.
    for (const VkFormat format : {VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R16G16_SFLOAT}) {
        if ((optimal_features(get_properties, physical_device, format) & needed) == needed) {
            return format;
        }
    }
    return VK_FORMAT_UNDEFINED;
}

std::vector<std::string> missing_requirements(PFN_vkGetInstanceProcAddr get, VkInstance instance,
                                              VkPhysicalDevice physical_device,
                                              std::uint32_t queue_family) {
    Reasons missing;
    InstanceFunctions functions;
    load(get, instance, "vkGetPhysicalDeviceProperties", functions.properties, missing);
    load(get, instance, "vkGetPhysicalDeviceQueueFamilyProperties", functions.queue_families,
         missing);
    load(get, instance, "vkGetPhysicalDeviceFormatProperties", functions.format, missing);
    if (!missing.empty()) {
        return missing;
    }
    VkPhysicalDeviceProperties properties{};
    functions.properties(physical_device, &properties);
    check_version(properties, missing);
    check_queue_family(functions, physical_device, queue_family, missing);
    check_limits(properties.limits, missing);
    check_formats(functions, physical_device, missing);
    return missing;
}

}  // namespace nearfield::gpu
