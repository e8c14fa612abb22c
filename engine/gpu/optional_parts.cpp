#include <engine/gpu/requirements.hpp>
#include <engine/gpu/strategies.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

namespace nearfield::gpu {
namespace {

using Reasons = std::vector<std::string>;

/// The usable Vulkan version: the device's, limited to the version that the instance was created
/// for.
std::uint32_t usable_version(const PhysicalDevice& device) {
    VkPhysicalDeviceProperties properties{};
    if (const auto get = find_function<PFN_vkGetPhysicalDeviceProperties>(
            device, "vkGetPhysicalDeviceProperties")) {
        get(device.physical_device, &properties);
    }
    return std::min(properties.apiVersion,
                    device.api_version == 0 ? VK_API_VERSION_1_1 : device.api_version);
}

VkPhysicalDeviceFeatures offered_features(const PhysicalDevice& device) {
    VkPhysicalDeviceFeatures features{};
    if (const auto get =
            find_function<PFN_vkGetPhysicalDeviceFeatures>(device, "vkGetPhysicalDeviceFeatures")) {
        get(device.physical_device, &features);
    }
    return features;
}

bool offers_extension(const PhysicalDevice& device, const char* name) {
    const auto get = find_function<PFN_vkEnumerateDeviceExtensionProperties>(
        device, "vkEnumerateDeviceExtensionProperties");
    std::uint32_t count = 0;
    if (get == nullptr || get(device.physical_device, nullptr, &count, nullptr) < VK_SUCCESS) {
        return false;
    }
    std::vector<VkExtensionProperties> extensions(count);
    if (get(device.physical_device, nullptr, &count, extensions.data()) < VK_SUCCESS) {
        return false;
    }
    extensions.resize(count);
    return std::any_of(extensions.begin(), extensions.end(), [name](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

void add(Requirements& requirements, const char* name, const char* unlocks, Reasons missing) {
    const bool available = missing.empty();
    requirements.optional.push_back({name, unlocks, available, std::move(missing)});
}

void add_raster(const PhysicalDevice& device, Requirements& requirements) {
    const auto get = find_function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        device, "vkGetPhysicalDeviceQueueFamilyProperties");
    Reasons missing;
    if (get == nullptr || !requirements.queue_family) {
        missing.emplace_back("VK_QUEUE_GRAPHICS_BIT: there is no queue family to ask");
    } else if ((queue_families(get, device.physical_device)[*requirements.queue_family].queueFlags &
                VK_QUEUE_GRAPHICS_BIT) == 0) {
        missing.push_back("VK_QUEUE_GRAPHICS_BIT: queue family " +
                          std::to_string(*requirements.queue_family) +
                          " lacks it, so it computes and does not draw");
    }
    add(requirements, "VK_QUEUE_GRAPHICS_BIT", "Technique::raster; compute and cpu work without",
        std::move(missing));
}

void add_strategies(const PhysicalDevice& device, Requirements& requirements) {
    requirements.features.logicOp = offered_features(device).logicOp;
    StrategySupport support{requirements.features.logicOp == VK_TRUE, 0};
    bool precise_gradients = false;
    if (const auto get = find_function<PFN_vkGetPhysicalDeviceFormatProperties>(
            device, "vkGetPhysicalDeviceFormatProperties")) {
        support = strategy_support(get, device.physical_device, support.logic_op);
        precise_gradients =
            find_gradient_format(get, device.physical_device) == VK_FORMAT_R32G32_SFLOAT;
    }
    add(requirements, "logicOp",
        "IntersectionStrategy::logic_op; enable the feature and say so in HostDevice::logic_op",
        missing_for(IntersectionStrategy::logic_op, support));
    add(requirements, "blending of VK_FORMAT_R8G8B8A8_UNORM", "IntersectionStrategy::blend",
        missing_for(IntersectionStrategy::blend, support));
    add(requirements, "blending of VK_FORMAT_R32G32_SFLOAT",
        "GradientMethod::blended in single precision; half precision without",
        precise_gradients
            ? Reasons{}
            : Reasons{"format VK_FORMAT_R32G32_SFLOAT: optimal tiling cannot be blended "
                      "and sampled, so VK_FORMAT_R16G16_SFLOAT is used"});
}

void add_timeline_semaphores(const PhysicalDevice& device, Requirements& requirements) {
    Reasons missing;
    const bool core = usable_version(device) >= VK_API_VERSION_1_2;
    const char* const extension = VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME;
    const auto get_features = find_function<PFN_vkGetPhysicalDeviceFeatures2>(
        device, "vkGetPhysicalDeviceFeatures2", "vkGetPhysicalDeviceFeatures2KHR");
    if (!core && !offers_extension(device, extension)) {
        missing.push_back(std::string("extension ") + extension +
                          ": the device does not offer it, and the instance was not said to be "
                          "created for Vulkan 1.2");
    } else if (get_features == nullptr) {
        missing.emplace_back(
            "entry point vkGetPhysicalDeviceFeatures2: vkGetInstanceProcAddr knows neither it nor "
            "its alias vkGetPhysicalDeviceFeatures2KHR");
    } else {
        VkPhysicalDeviceTimelineSemaphoreFeatures timeline = requirements.timeline_semaphore;
        VkPhysicalDeviceFeatures2 features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        features.pNext = &timeline;
        get_features(device.physical_device, &features);
        requirements.timeline_semaphore.timelineSemaphore = timeline.timelineSemaphore;
        if (timeline.timelineSemaphore != VK_TRUE) {
            missing.emplace_back("feature timelineSemaphore: the device does not offer it");
        } else if (!core) {
            requirements.device_extensions.push_back(extension);
        }
    }
    add(requirements, "timelineSemaphore",
        "values of timeline semaphores in Submission; enable the feature and say so in "
        "HostDevice::timeline_semaphore",
        std::move(missing));
}

void add_timestamps(const PhysicalDevice& device, Requirements& requirements) {
    const auto get = find_function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        device, "vkGetPhysicalDeviceQueueFamilyProperties");
    Reasons missing;
    if (get == nullptr || !requirements.queue_family) {
        missing.emplace_back("timestamps: there is no queue family to ask");
    } else if (queue_families(get, device.physical_device)[*requirements.queue_family]
                   .timestampValidBits == 0) {
        missing.push_back("timestamps: queue family " + std::to_string(*requirements.queue_family) +
                          " has none (timestampValidBits is 0)");
    }
    add(requirements, "timestamps", "Timings::passes, the times of passes on the device",
        std::move(missing));
}

void add_debug_utils(const PhysicalDevice& device, Requirements& requirements) {
    requirements.instance_extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    add(requirements, VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
        "names of all objects and labels of all passes; enable the extension on the instance and "
        "say so in HostDevice::debug_utils",
        device.debug_utils
            ? Reasons{}
            : Reasons{"extension VK_EXT_debug_utils: it was not said to be enabled on the "
                      "instance (PhysicalDevice::debug_utils)"});
}

}  // namespace

void survey_optional_parts(const PhysicalDevice& device, Requirements& requirements) {
    add_raster(device, requirements);
    add_strategies(device, requirements);
    add_timeline_semaphores(device, requirements);
    add_timestamps(device, requirements);
    add_debug_utils(device, requirements);
}

}  // namespace nearfield::gpu
