#pragma once

#include "own_device.hpp"

#include <cstdint>
#include <vector>

namespace nearfield::examples {

/// A buffer that stays mapped.
struct HostBuffer {
    HostBuffer() = default;
    HostBuffer(vk::PhysicalDevice physical_device, vk::Device device, vk::DeviceSize bytes,
               vk::BufferUsageFlags usage);

    vk::UniqueDeviceMemory memory;
    vk::UniqueBuffer buffer;  ///< destroyed before its memory
    vk::DeviceSize size = 0;
    void* mapped = nullptr;
};

/// An image with its own memory and view.
struct DeviceImage {
    DeviceImage() = default;
    DeviceImage(vk::PhysicalDevice physical_device, vk::Device device, vk::Format format,
                vk::Extent2D extent, vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect);

    vk::UniqueDeviceMemory memory;
    vk::UniqueImage image;
    vk::UniqueImageView view;
};

/// Makes a view of the whole image.
[[nodiscard]] vk::UniqueImageView make_view(vk::Device device, vk::Image image, vk::Format format,
                                            vk::ImageAspectFlags aspect);

/// Reads the pixels of a colour image with 4 bytes each, row by row from the top; waits for the
/// device. The image is in `layout`, keeps it, and must have been made as a copy source.
[[nodiscard]] std::vector<std::uint8_t> read_back(const OwnDevice& device, vk::Image image,
                                                  vk::ImageLayout layout, vk::Extent2D extent);

}  // namespace nearfield::examples
