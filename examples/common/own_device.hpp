#pragma once

#include <nearfield/host.hpp>

#include <vulkan/vulkan.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nearfield::examples {

/// The loader's instance extensions that create window surfaces (VK_KHR_surface, VK_KHR_xcb_surface
/// and similar ones).
[[nodiscard]] std::vector<std::string> surface_extensions();

/// A Vulkan 1.1 instance.
[[nodiscard]] vk::UniqueInstance make_instance(const std::vector<std::string>& extensions);

/// Whether a queue family can present to the window.
using CanPresent = std::function<bool(vk::PhysicalDevice, std::uint32_t family)>;

/// A device with one queue that draws, computes and presents.
class OwnDevice {
public:
    OwnDevice(vk::Instance instance, const CanPresent& can_present);

    [[nodiscard]] vk::PhysicalDevice physical_device() const { return physical_device_; }
    [[nodiscard]] vk::Device device() const { return *device_; }
    [[nodiscard]] vk::Queue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }

private:
    void choose(vk::Instance instance, const CanPresent& can_present);

    vk::PhysicalDevice physical_device_;
    vk::UniqueDevice device_;
    vk::Queue queue_;
    std::uint32_t queue_family_ = 0;
};

/// The handles for nearfield.
[[nodiscard]] HostDevice host_device(vk::Instance instance, const OwnDevice& device);

}  // namespace nearfield::examples
