#pragma once

#include <nearfield/host.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nearfield::examples {

/// The loader's instance extensions that create window surfaces (VK_KHR_surface, VK_KHR_xcb_surface
/// and similar ones).
[[nodiscard]] std::vector<std::string> surface_extensions();

/// A Vulkan 1.1 instance.
class OwnInstance {
public:
    explicit OwnInstance(const std::vector<std::string>& extensions);
    ~OwnInstance() { vkDestroyInstance(instance_, nullptr); }
    OwnInstance(const OwnInstance&) = delete;
    OwnInstance& operator=(const OwnInstance&) = delete;

    [[nodiscard]] VkInstance get() const { return instance_; }

private:
    VkInstance instance_ = VK_NULL_HANDLE;
};

/// Whether a queue family can present to the window.
using CanPresent = std::function<bool(VkPhysicalDevice, std::uint32_t family)>;

/// A device with one queue that draws, computes and presents.
class OwnDevice {
public:
    OwnDevice(VkInstance instance, const CanPresent& can_present);
    ~OwnDevice() { vkDestroyDevice(device_, nullptr); }
    OwnDevice(const OwnDevice&) = delete;
    OwnDevice& operator=(const OwnDevice&) = delete;

    [[nodiscard]] VkPhysicalDevice physical_device() const { return physical_device_; }
    [[nodiscard]] VkDevice device() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }

private:
    void choose(VkInstance instance, const CanPresent& can_present);

    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
};

/// The handles for nearfield.
[[nodiscard]] HostDevice host_device(VkInstance instance, const OwnDevice& device);

}  // namespace nearfield::examples
