#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>

#include <string>

namespace nearfield::gpu {

/// A colour image of its own memory, with a view of all of it, that only grows: for compute shaders
/// to write, for whoever uses the library to sample and to copy from.
class KeptImage {
public:
    KeptImage(const Device& device, VkFormat format, std::string name);

    /// Makes it at least so large along both sides. Where it has to grow content and handles are
    /// lost; must not be called while the device uses the image. Throws Failure; the image is then
    /// empty.
    void reserve(VkExtent2D extent);

    [[nodiscard]] VkImage handle() const { return image_.get(); }
    [[nodiscard]] VkImageView view() const { return view_.get(); }
    [[nodiscard]] VkFormat format() const { return format_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }

private:
    void create_image(VkExtent2D extent);
    void allocate_memory();
    void create_view();

    const Device* device_;
    VkFormat format_;
    std::string name_;
    DeviceMemory memory_;  // before the image bound to it, so it is freed after
    Owned<VkImage> image_;
    Owned<VkImageView> view_;
    VkExtent2D extent_{};
};

}  // namespace nearfield::gpu
