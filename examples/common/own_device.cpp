#include "own_device.hpp"

#include "value_of.hpp"

#include <nearfield/requirements.hpp>

namespace nearfield::examples {

std::vector<std::string> surface_extensions() {
    std::vector<std::string> names;
    for (const vk::ExtensionProperties& extension : vk::enumerateInstanceExtensionProperties()) {
        const std::string name = extension.extensionName;
        if (name.starts_with("VK_KHR_") && name.ends_with("_surface")) {
            names.push_back(name);
        }
    }
    return names;
}

vk::UniqueInstance make_instance(const std::vector<std::string>& extensions) {
    std::vector<const char*> names;
    names.reserve(extensions.size());
    for (const std::string& extension : extensions) {
        names.push_back(extension.c_str());
    }
    const auto application = vk::ApplicationInfo()
                                 .setPApplicationName("nearfield example")
                                 .setApiVersion(VK_API_VERSION_1_1);
    return vk::createInstanceUnique(vk::InstanceCreateInfo()
                                        .setPApplicationInfo(&application)
                                        .setPEnabledExtensionNames(names));
}

OwnDevice::OwnDevice(vk::Instance instance, const CanPresent& can_present) {
    choose(instance, can_present);
    const float priority = 1.0F;
    const auto queue =
        vk::DeviceQueueCreateInfo().setQueueFamilyIndex(queue_family_).setQueuePriorities(priority);
    const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    device_ = physical_device_.createDeviceUnique(
        vk::DeviceCreateInfo().setQueueCreateInfos(queue).setPEnabledExtensionNames(swapchain));
    queue_ = device_->getQueue(queue_family_, 0);
}

// Selects the first family that nearfield can use and that can present.
void OwnDevice::choose(vk::Instance instance, const CanPresent& can_present) {
    const std::vector<vk::PhysicalDevice> devices = instance.enumeratePhysicalDevices();
    std::string reasons;
    for (const vk::PhysicalDevice device : devices) {
        const auto families = static_cast<std::uint32_t>(device.getQueueFamilyProperties().size());
        for (std::uint32_t family = 0; family < families; ++family) {
            PhysicalDevice asked;
            asked.instance = instance;
            asked.physical_device = device;
            asked.queue_family = family;
            asked.get_instance_proc_addr = vkGetInstanceProcAddr;
            asked.api_version = VK_API_VERSION_1_1;
            const Requirements needed = value_of(requirements(asked));
            const bool draws = needed.find("VK_QUEUE_GRAPHICS_BIT")->available;
            if (needed.met() && draws && can_present(device, family)) {
                physical_device_ = device;
                queue_family_ = family;
                return;
            }
            for (const std::string& unmet : needed.unmet) {
                reasons += "\n- " + unmet;
            }
        }
    }
    throw std::runtime_error("none of " + std::to_string(devices.size()) +
                             " Vulkan devices has a queue family that will do and that presents to "
                             "this window" +
                             reasons);
}

HostDevice host_device(vk::Instance instance, const OwnDevice& device) {
    HostDevice host;
    host.instance = instance;
    host.physical_device = device.physical_device();
    host.device = device.device();
    host.queue = device.queue();
    host.queue_family = device.queue_family();
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    host.api_version = VK_API_VERSION_1_1;
    return host;
}

}  // namespace nearfield::examples
