#pragma once

#include <tools/rendering/gpu.hpp>

#include <cstddef>
#include <span>

namespace nearfield::tools {

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
