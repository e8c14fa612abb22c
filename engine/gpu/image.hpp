#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace nearfield::gpu {

/// An image of two dimensions and one level, shared by the queue families if there are several.
[[nodiscard]] Owned<VkImage> make_image(const Device& device, VkFormat format, VkExtent2D extent,
                                        VkImageUsageFlags usage, const std::string& name,
                                        VkImageCreateFlags flags = 0,
                                        std::span<const std::uint32_t> families = {});
/// A view of all of such an image.
[[nodiscard]] Owned<VkImageView> make_view(const Device& device, VkImage image, VkFormat format,
                                           VkImageAspectFlags aspects, const std::string& name);

/// A colour image with memory of its own and a view of all of it, which only grows: compute shaders
/// write it, the library's user samples it and copies from it. Shared by
/// Device::reader_families().
class KeptImage {
public:
    KeptImage(const Device& device, VkFormat format, std::string name);

    /// Grows the image to at least this size along both sides. Growing discards content and handles
    /// and must not happen while the device uses the image. Returns true if the image was replaced.
    /// Throws StatusException; after any exception there is no image.
    bool reserve(VkExtent2D extent);

    [[nodiscard]] VkImage handle() const { return image_.get(); }
    [[nodiscard]] VkImageView view() const { return view_.get(); }
    [[nodiscard]] VkFormat format() const { return format_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }

private:
    void allocate_memory();

    const Device* device_;
    VkFormat format_;
    std::string name_;
    DeviceMemory memory_;  // declared before the image bound to it, so it is freed after
    Owned<VkImage> image_;
    Owned<VkImageView> view_;
    VkExtent2D extent_{};
};

}  // namespace nearfield::gpu
