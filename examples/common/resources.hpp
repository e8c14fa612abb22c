#pragma once

#include "own_device.hpp"
#include "owned.hpp"

#include <cstdint>
#include <vector>

namespace nearfield::examples {

/// A buffer that stays mapped.
struct HostBuffer {
    HostBuffer() = default;
    HostBuffer(VkPhysicalDevice physical_device, VkDevice device, VkDeviceSize size,
               VkBufferUsageFlags usage);

    Memory memory;
    Buffer buffer;  ///< destroyed before its memory
    VkDeviceSize size = 0;
    void* mapped = nullptr;
};

/// An image with memory and view of its own.
struct DeviceImage {
    DeviceImage() = default;
    DeviceImage(VkPhysicalDevice physical_device, VkDevice device, VkFormat format,
                VkExtent2D extent, VkImageUsageFlags usage, VkImageAspectFlags aspect);

    Memory memory;
    Image image;
    ImageView view;
};

/// A view of all of a plain image.
[[nodiscard]] ImageView make_view(VkDevice device, VkImage image, VkFormat format,
                                  VkImageAspectFlags aspect);

/// The pixels of a colour image of 4 bytes each, row by row from the top; waits for the device. The
/// image has `layout` and keeps it, and was made to be copied from.
[[nodiscard]] std::vector<std::uint8_t> read_back(const OwnDevice& device, VkImage image,
                                                  VkImageLayout layout, VkExtent2D extent);

}  // namespace nearfield::examples
