#include <nearfield/requirements.hpp>

#include <tools/common/library_error.hpp>
#include <tools/rendering/gpu.hpp>

#include <algorithm>

namespace nearfield::tools {
namespace {

vk::raii::Context open_loader() {
    try {
        return {};
    } catch (const std::runtime_error& error) {
        throw NoGpu(std::string("there is no Vulkan loader: ") + error.what());
    }
}

vk::raii::Instance make_instance(const vk::raii::Context& loader,
                                 const std::vector<std::string>& extensions) {
    std::vector<const char*> names;
    names.reserve(extensions.size());
    for (const std::string& extension : extensions) {
        names.push_back(extension.c_str());
    }
    const auto application =
        vk::ApplicationInfo().setPApplicationName("nearfield").setApiVersion(VK_API_VERSION_1_1);
    try {
        return {loader, vk::InstanceCreateInfo()
                            .setPApplicationInfo(&application)
                            .setPEnabledExtensionNames(names)};
    } catch (const vk::SystemError& error) {
        throw NoGpu(std::string("there is no Vulkan instance: ") + error.what());
    }
}

bool offers_debug_utils(const vk::raii::Context& loader) {
    const auto all = loader.enumerateInstanceExtensionProperties();
    return std::any_of(all.begin(), all.end(), [](const vk::ExtensionProperties& extension) {
        return std::string(extension.extensionName.data()) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    });
}

std::vector<std::string> with_debug_utils(std::vector<std::string> extensions, bool offered) {
    if (offered) {
        extensions.emplace_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    return extensions;
}

/// Better kinds of device come first.
int rank(const vk::raii::PhysicalDevice& device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 1;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        default:
            return 3;
    }
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, const Requirements& needed,
                             std::uint32_t family, bool presents) {
    const float priority = 1.0F;
    const auto queue =
        vk::DeviceQueueCreateInfo().setQueueFamilyIndex(family).setQueuePriorities(priority);
    std::vector<const char*> extensions;
    if (presents) {
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    }
    const auto features =
        vk::PhysicalDeviceFeatures().setLogicOp(static_cast<vk::Bool32>(needed.features.logicOp));
    return {physical, vk::DeviceCreateInfo()
                          .setQueueCreateInfos(queue)
                          .setPEnabledExtensionNames(extensions)
                          .setPEnabledFeatures(&features)};
}

}  // namespace

GpuInstance::GpuInstance(const std::vector<std::string>& extensions)
    : loader_(open_loader()),
      debug_utils_(offers_debug_utils(loader_)),
      instance_(make_instance(loader_, with_debug_utils(extensions, debug_utils_))) {}

Gpu::Gpu(const GpuInstance& instance, const CanPresent& can_present) {
    std::vector<vk::raii::PhysicalDevice> devices;
    std::string reasons;
    try {
        for (vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance.get())) {
            devices.push_back(std::move(device));
        }
    } catch (const vk::SystemError& error) {
        reasons = std::string("; ") + error.what();
    }
    std::stable_sort(devices.begin(), devices.end(),
                     [](const vk::raii::PhysicalDevice& a, const vk::raii::PhysicalDevice& b) {
                         return rank(a) < rank(b);
                     });
    PhysicalDevice asked;
    asked.instance = *instance.get();
    asked.get_instance_proc_addr = instance.get_instance_proc_addr();
    asked.debug_utils = instance.debug_utils();
    for (vk::raii::PhysicalDevice& device : devices) {
        asked.physical_device = *device;
        const auto families = static_cast<std::uint32_t>(device.getQueueFamilyProperties().size());
        for (std::uint32_t family = 0; family < families; ++family) {
            asked.queue_family = family;
            const Requirements needed = take(requirements(asked));
            const std::string subject = std::string("; ") +
                                        device.getProperties().deviceName.data() +
                                        ", queue family " + std::to_string(family) + ": ";
            for (const std::string& unmet : needed.unmet) {
                reasons += subject + unmet;
            }
            const OptionalPart& drawing = *needed.find("VK_QUEUE_GRAPHICS_BIT");
            for (const std::string& missing : drawing.missing) {
                reasons += subject + missing;
            }
            if (!needed.met() || !drawing.available) {
                continue;
            }
            if (can_present && !can_present(device, family)) {
                reasons += subject + "cannot present to this window";
                continue;
            }
            physical_ = std::move(device);
            device_ = make_device(physical_, needed, family, static_cast<bool>(can_present));
            queue_ = vk::raii::Queue(device_, family, 0);
            host_.instance = asked.instance;
            host_.physical_device = *physical_;
            host_.device = *device_;
            host_.queue = *queue_;
            host_.queue_family = family;
            host_.get_instance_proc_addr = asked.get_instance_proc_addr;
            host_.debug_utils = asked.debug_utils;
            host_.logic_op = needed.features.logicOp == VK_TRUE;
            return;
        }
    }
    throw NoGpu("none of " + std::to_string(devices.size()) + " Vulkan devices can be used" +
                reasons);
}

}  // namespace nearfield::tools
