#include <engine/base/status_exception.hpp>
#include <engine/gpu/requirements.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

namespace nearfield::gpu {
namespace {

constexpr VkFormatFeatureFlags gradient_features =
    VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;

// Formats that the base requires, with optimal tiling. Alternatives are adjacent.
constexpr std::array<RequiredFormat, 11> format_table{{
    {VK_FORMAT_R32_UINT, "VK_FORMAT_R32_UINT", VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, 0,
     "signs and feature ids are drawn to it", false},
    {VK_FORMAT_R32_UINT, "VK_FORMAT_R32_UINT", VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, 0,
     "signs and feature ids are read by compute passes", false},
    {VK_FORMAT_R32_UINT, "VK_FORMAT_R32_UINT", VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, 0,
     "feature ids that stay on the device are written to it", false},
    {VK_FORMAT_R32_SFLOAT, "VK_FORMAT_R32_SFLOAT",
     VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, 0,
     "signed distances that stay on the device are written to it", false},
    {VK_FORMAT_D32_SFLOAT, "VK_FORMAT_D32_SFLOAT", VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
     0, "the nearest feature wins by depth", false},
    {VK_FORMAT_R8_UNORM, "VK_FORMAT_R8_UNORM", VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT, 0,
     "signs are drawn white on black to it", false},
    {VK_FORMAT_R8G8B8A8_UNORM, "VK_FORMAT_R8G8B8A8_UNORM",
     VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT, 0,
     "signs are drawn as the top bit of feature ids to it", false},
    // Every device has at least one of the two.
    {VK_FORMAT_D32_SFLOAT_S8_UINT, "VK_FORMAT_D32_SFLOAT_S8_UINT",
     VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, 0,
     "the stencil format is for shapes that are filled by parity", true},
    {VK_FORMAT_D24_UNORM_S8_UINT, "VK_FORMAT_D24_UNORM_S8_UINT",
     VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, 0,
     "the stencil format is for shapes that are filled by parity", false},
    // Every device blends the second; few lack the first.
    {VK_FORMAT_R32G32_SFLOAT, "VK_FORMAT_R32G32_SFLOAT", gradient_features, 0,
     "the gradient format is for gradients that are blended in it", true},
    {VK_FORMAT_R16G16_SFLOAT, "VK_FORMAT_R16G16_SFLOAT", gradient_features, 0,
     "the gradient format is for gradients that are blended in it", false},
}};

std::string feature_names(VkFormatFeatureFlags features) {
    constexpr std::array<std::pair<VkFormatFeatureFlags, const char*>, 5> table{{
        {VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT"},
        {VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT"},
        {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT"},
        {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
         "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT"},
        {VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
         "VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT"},
    }};
    std::string names;
    for (const auto& [feature, name] : table) {
        if ((features & feature) != 0) {
            names += (names.empty() ? "" : " and ") + std::string(name);
        }
    }
    return names;
}

VkFormatFeatureFlags optimal_features(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                      VkPhysicalDevice device, VkFormat format) {
    VkFormatProperties properties{};
    get_properties(device, format, &properties);
    return properties.optimalTilingFeatures;
}

/// The first of some formats that meets all of the table's requirements for it.
VkFormat first_sufficient(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                          VkPhysicalDevice device, std::initializer_list<VkFormat> formats) {
    for (const VkFormat format : formats) {
        VkFormatFeatureFlags needed = 0;
        for (const RequiredFormat& row : format_table) {
            needed |= row.format == format ? row.needed : 0;
        }
        if ((optimal_features(get_properties, device, format) & needed) == needed) {
            return format;
        }
    }
    return VK_FORMAT_UNDEFINED;
}

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version));
}

void check_version(const PhysicalDevice& device, const VkPhysicalDeviceProperties& properties,
                   Requirements& requirements) {
    const std::string needed = "Vulkan " + version_text(requirements.api_version) + ": ";
    if (properties.apiVersion < requirements.api_version) {
        requirements.unmet.push_back(needed + "the device offers Vulkan " +
                                     version_text(properties.apiVersion) +
                                     " only, and shaders are SPIR-V 1.3");
    }
    if (device.api_version != 0 && device.api_version < requirements.api_version) {
        requirements.unmet.push_back(needed + "the instance was created for Vulkan " +
                                     version_text(device.api_version) +
                                     " only (api_version), and shaders are SPIR-V 1.3");
    }
}

/// The first family that can do all of it.
std::optional<std::uint32_t> find_family(const std::vector<VkQueueFamilyProperties>& families,
                                         VkQueueFlags needed) {
    const auto found = std::find_if(families.begin(), families.end(), [needed](const auto& each) {
        return (each.queueFlags & needed) == needed;
    });
    return found == families.end()
               ? std::nullopt
               : std::optional(static_cast<std::uint32_t>(found - families.begin()));
}

/// Selects the requested family. If none is requested: the first family that computes and draws;
/// otherwise the first that computes; otherwise the first of all, whose missing capability is then
/// reported.
void choose_queue_family(const PhysicalDevice& device,
                         const std::vector<VkQueueFamilyProperties>& families,
                         Requirements& requirements) {
    const VkQueueFlags needed = requirements.queue_flags;
    std::uint32_t family = device.queue_family;
    if (family == PhysicalDevice::any_queue_family) {
        family = find_family(families, needed | VK_QUEUE_GRAPHICS_BIT)
                     .value_or(find_family(families, needed).value_or(0));
    }
    const std::string name = "queue family " + std::to_string(family);
    if (family >= families.size()) {
        requirements.unmet.push_back(name + ": the device has " + std::to_string(families.size()) +
                                     " queue families");
    } else if ((families[family].queueFlags & needed) != needed) {
        requirements.unmet.push_back("VK_QUEUE_COMPUTE_BIT: " + name +
                                     " lacks it, and every technique of a device computes");
    } else {
        requirements.queue_family = family;
    }
}

void check_limits(const VkPhysicalDeviceLimits& limits, Requirements& requirements) {
    // Every conformant device meets these limits; one that does not cannot be trusted otherwise
    // either.
    requirements.limits = {
        {"subPixelPrecisionBits", 4, limits.subPixelPrecisionBits,
         "vertices are snapped to the sub-pixel grid"},
        {"maxPerStageDescriptorStorageBuffers", 4, limits.maxPerStageDescriptorStorageBuffers,
         "a compute pass uses as many storage buffers"},
        {"maxPerStageDescriptorStorageImages", 2, limits.maxPerStageDescriptorStorageImages,
         "a field that stays on the device is written to two images"},
        {"maxComputeWorkGroupInvocations", 128, limits.maxComputeWorkGroupInvocations,
         "compute passes work in groups of up to as many"},
    };
    for (const RequiredLimit& limit : requirements.limits) {
        if (limit.offered < limit.needed) {
            requirements.unmet.push_back(std::string("limit ") + limit.name +
                                         ": the device offers " + std::to_string(limit.offered) +
                                         ", at least " + std::to_string(limit.needed) +
                                         " needed because " + limit.why);
        }
    }
}

void check_formats(PFN_vkGetPhysicalDeviceFormatProperties get_properties, VkPhysicalDevice device,
                   Requirements& requirements) {
    std::string lacking;  // of the alternatives so far
    bool met = false;
    for (RequiredFormat row : format_table) {
        row.offered = optimal_features(get_properties, device, row.format);
        met = met || (row.offered & row.needed) == row.needed;
        lacking += (lacking.empty() ? "" : ", and so does format ") + std::string(row.name);
        if (!row.or_next) {
            if (!met) {
                const VkFormatFeatureFlags missing = row.needed & ~row.offered;
                requirements.unmet.push_back("format " + lacking + ": optimal tiling lacks " +
                                             feature_names(missing) + ", and " + row.why);
            }
            lacking.clear();
            met = false;
        }
        requirements.formats.push_back(row);
    }
}

}  // namespace

void require_vulkan_1(std::uint32_t api_version, const char* structure) {
    const bool of_vulkan =
        VK_API_VERSION_VARIANT(api_version) == 0 && VK_API_VERSION_MAJOR(api_version) == 1;
    if (api_version != 0 && !of_vulkan) {
        throw StatusException(
            {StatusCode::invalid_settings,
             std::string(structure) + "::api_version is " + std::to_string(api_version) +
                 ", which is no version of Vulkan 1 but " + version_text(api_version) +
                 " of variant " + std::to_string(VK_API_VERSION_VARIANT(api_version)) +
                 "; give VkApplicationInfo::apiVersion, or leave it 0"});
    }
}

std::vector<VkQueueFamilyProperties> queue_families(
    PFN_vkGetPhysicalDeviceQueueFamilyProperties get, VkPhysicalDevice device) {
    std::uint32_t count = 0;
    get(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get(device, &count, families.data());
    families.resize(count);
    return families;
}

VkFormat find_stencil_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                             VkPhysicalDevice physical_device) {
    return first_sufficient(get_properties, physical_device,
                            {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT});
}

VkFormat find_gradient_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                              VkPhysicalDevice physical_device) {
    return first_sufficient(get_properties, physical_device,
                            {VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R16G16_SFLOAT});
}

void survey_base(const PhysicalDevice& device, Requirements& requirements) {
    const auto require = [&]<class Function>(Function& function, const char* name) {
        function = find_function<Function>(device, name);
        if (function == nullptr) {
            requirements.unmet.push_back(std::string("entry point ") + name +
                                         ": vkGetInstanceProcAddr does not know it");
        }
    };
    PFN_vkGetPhysicalDeviceProperties get_properties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties get_families = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties get_format = nullptr;
    require(get_properties, "vkGetPhysicalDeviceProperties");
    require(get_families, "vkGetPhysicalDeviceQueueFamilyProperties");
    require(get_format, "vkGetPhysicalDeviceFormatProperties");
    if (!requirements.unmet.empty()) {
        return;
    }
    VkPhysicalDeviceProperties properties{};
    get_properties(device.physical_device, &properties);
    check_version(device, properties, requirements);
    choose_queue_family(device, queue_families(get_families, device.physical_device), requirements);
    check_limits(properties.limits, requirements);
    check_formats(get_format, device.physical_device, requirements);
}

}  // namespace nearfield::gpu
