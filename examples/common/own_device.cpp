#include "own_device.hpp"

#include "resources.hpp"

#include <nearfield/requirements.hpp>

namespace nearfield::examples {

std::vector<std::string> surface_extensions() {
    std::uint32_t count = 0;
    require(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr),
            "vkEnumerateInstanceExtensionProperties");
    std::vector<VkExtensionProperties> all(count);
    require(vkEnumerateInstanceExtensionProperties(nullptr, &count, all.data()),
            "vkEnumerateInstanceExtensionProperties");
    std::vector<std::string> names;
    for (const VkExtensionProperties& extension : all) {
        const std::string name = extension.extensionName;
        if (name.starts_with("VK_KHR_") && name.ends_with("_surface")) {
            names.push_back(name);
        }
    }
    return names;
}

OwnInstance::OwnInstance(const std::vector<std::string>& extensions) {
    std::vector<const char*> names;
    names.reserve(extensions.size());
    for (const std::string& extension : extensions) {
        names.push_back(extension.c_str());
    }
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "nearfield example";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    info.ppEnabledExtensionNames = names.data();
    require(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
}

OwnDevice::OwnDevice(VkInstance instance, const CanPresent& can_present) {
    choose(instance, can_present);
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &swapchain;
    require(vkCreateDevice(physical_device_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

// Selects the first family that nearfield can use and that can present.
void OwnDevice::choose(VkInstance instance, const CanPresent& can_present) {
    std::uint32_t count = 0;
    require(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    require(vkEnumeratePhysicalDevices(instance, &count, devices.data()),
            "vkEnumeratePhysicalDevices");
    std::string reasons;
    for (VkPhysicalDevice device : devices) {
        std::uint32_t family_count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(device, &family_count, nullptr);
        for (std::uint32_t family = 0; family < family_count; ++family) {
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
    throw std::runtime_error("none of " + std::to_string(count) +
                             " Vulkan devices has a queue family that will do and that presents to "
                             "this window" +
                             reasons);
}

HostDevice host_device(VkInstance instance, const OwnDevice& device) {
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
