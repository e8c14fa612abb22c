#pragma once

#include <nearfield/host.hpp>

#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield::tools {

/// Thrown if there is no device to draw with; the message lists every reason.
class NoGpu : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A Vulkan 1.1 instance and its loader.
class GpuInstance {
public:
    /// Enables the extensions that a window needs. Throws NoGpu.
    explicit GpuInstance(const std::vector<std::string>& extensions = {});

    [[nodiscard]] const vk::raii::Instance& get() const { return instance_; }
    /// True if VK_EXT_debug_utils is enabled.
    [[nodiscard]] bool debug_utils() const { return debug_utils_; }
    [[nodiscard]] PFN_vkGetInstanceProcAddr get_instance_proc_addr() const {
        return loader_.getDispatcher()->vkGetInstanceProcAddr;
    }

private:
    vk::raii::Context loader_;
    bool debug_utils_ = false;
    vk::raii::Instance instance_;
};

/// A device that nearfield shares: one queue that draws, computes and, if requested, presents.
class Gpu {
public:
    /// Whether a queue family can present to the window.
    using CanPresent = std::function<bool(const vk::raii::PhysicalDevice&, std::uint32_t family)>;

    /// Selects the best suitable kind of device: discrete, integrated, virtual, then a CPU
    /// implementation. Throws NoGpu.
    explicit Gpu(const GpuInstance& instance, const CanPresent& can_present = {});

    [[nodiscard]] const vk::raii::PhysicalDevice& physical_device() const { return physical_; }
    [[nodiscard]] const vk::raii::Device& device() const { return device_; }
    [[nodiscard]] const vk::raii::Queue& queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return host_.queue_family; }
    /// The handles for nearfield.
    [[nodiscard]] const HostDevice& host_device() const { return host_; }

private:
    vk::raii::PhysicalDevice physical_{nullptr};
    vk::raii::Device device_{nullptr};
    vk::raii::Queue queue_{nullptr};
    HostDevice host_;
};

}  // namespace nearfield::tools
