#pragma once

#include <tools/gpu/gpu.hpp>

#include <cstddef>
#include <span>

namespace nearfield::tools {

/// A buffer that the CPU writes and reads; it stays mapped.
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

/// A picture in device memory.
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

/// A whole colour image.
inline constexpr vk::ImageSubresourceRange whole_image{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};
inline constexpr vk::ImageSubresourceLayers whole_layer{vk::ImageAspectFlagBits::eColor, 0, 0, 1};

/// What an image is used for before and after a change of its layout.
struct ImageUse {
    vk::ImageLayout layout = vk::ImageLayout::eUndefined;
    vk::PipelineStageFlags stage = vk::PipelineStageFlagBits::eTopOfPipe;
    vk::AccessFlags access = {};
};
void change_use(const vk::raii::CommandBuffer& commands, vk::Image image, const ImageUse& before,
                const ImageUse& after);

/// A command buffer of its own, and a fence for its submission.
class Commands {
public:
    /// The fence is signalled.
    explicit Commands(const Gpu& gpu);

    /// Waits until the last submission is done, then begins anew.
    const vk::raii::CommandBuffer& begin();
    /// Ends and submits; waits for and signals semaphores where they are given.
    void submit(vk::Semaphore wait = {}, vk::Semaphore signal = {});
    void wait() const;

private:
    const Gpu& gpu_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_;
    vk::raii::Fence done_;
};

}  // namespace nearfield::tools
