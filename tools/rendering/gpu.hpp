#pragma once

#include <nearfield/host.hpp>

#include <vulkan/vulkan_raii.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
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

/// A buffer that the CPU reads and writes; it stays mapped.
class HostBuffer {
public:
    HostBuffer() = default;
    HostBuffer(const Gpu& gpu, std::size_t size, vk::BufferUsageFlags usage);

    [[nodiscard]] vk::Buffer get() const { return *buffer_; }
    [[nodiscard]] std::span<std::byte> bytes() const { return bytes_; }

private:
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Buffer buffer_{nullptr};  // destroyed before its memory
    std::span<std::byte> bytes_;
};

/// An image in device memory.
class DeviceImage {
public:
    DeviceImage() = default;
    DeviceImage(const Gpu& gpu, vk::Extent2D extent, vk::Format format,
                vk::SampleCountFlagBits samples, vk::ImageUsageFlags usage);

    [[nodiscard]] vk::Image get() const { return *image_; }
    [[nodiscard]] vk::ImageView view() const { return *view_; }

private:
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::Image image_{nullptr};
    vk::raii::ImageView view_{nullptr};
};

/// The full range of a colour image.
inline constexpr vk::ImageSubresourceRange whole_image{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};
inline constexpr vk::ImageSubresourceLayers whole_layer{vk::ImageAspectFlagBits::eColor, 0, 0, 1};

/// The use of an image before or after a layout transition.
struct ImageUse {
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
    vk::PipelineStageFlags stage = vk::PipelineStageFlagBits::eTopOfPipe;
    vk::AccessFlags access = {};
};
void change_use(const vk::raii::CommandBuffer& commands, vk::Image image, const ImageUse& before,
                const ImageUse& after);

/// A command buffer with a fence for its submission.
class Commands {
public:
    /// Creates the fence signalled.
    explicit Commands(const Gpu& gpu);

    /// Waits for the last submission, then begins recording.
    const vk::raii::CommandBuffer& begin();
    /// Ends and submits; waits for and signals the semaphores that are given.
    void submit(vk::Semaphore wait = {}, vk::Semaphore signal = {});
    void wait() const;

private:
    const Gpu& gpu_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_;
    vk::raii::Fence done_;
};

}  // namespace nearfield::tools
