#pragma once

#include "own_device.hpp"
#include "owned.hpp"

#include <cstdint>
#include <vector>

namespace nearfield::examples {

/// A buffer that stays mapped.
struct HostBuffer {
    HostBuffer() = default;
    HostBuffer(VkPhysicalDevice physical_device, VkDevice device, VkDeviceSize bytes,
               VkBufferUsageFlags usage);

    Memory memory;
    Buffer buffer;  ///< destroyed before its memory
    VkDeviceSize size = 0;
    void* mapped = nullptr;
};

/// An image with its own memory and view.
struct DeviceImage {
    DeviceImage() = default;
    DeviceImage(VkPhysicalDevice physical_device, VkDevice device, VkFormat format,
                VkExtent2D extent, VkImageUsageFlags usage, VkImageAspectFlags aspect);

    Memory memory;
    Image image;
    ImageView view;
};

/// Makes a view of the whole image.
[[nodiscard]] ImageView make_view(VkDevice device, VkImage image, VkFormat format,
                                  VkImageAspectFlags aspect);

/// Reads the pixels of a colour image with 4 bytes each, row by row from the top; waits for the
/// device. The image is in `layout`, keeps it, and must have been made as a copy source.
[[nodiscard]] std::vector<std::uint8_t> read_back(const OwnDevice& device, VkImage image,
                                                  VkImageLayout layout, VkExtent2D extent);

}  // namespace nearfield::examples
