#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/resident.hpp>

#include <vector>

namespace nearfield::render {

/// The views through which the library writes images of the host. Each is made when its level and
/// layer are first seen and kept until the image is released.
class TargetViews {
public:
    explicit TargetViews(const gpu::Device& device) : device_(&device) {}

    [[nodiscard]] VkImageView of(const ResidentImageTarget& target);
    /// Destroys the views of an image. The device must not be using them.
    void release(VkImage image);

private:
    struct Entry {
        VkImage image = VK_NULL_HANDLE;
        VkFormat format = VK_FORMAT_UNDEFINED;
        std::uint32_t level = 0;
        std::uint32_t layer = 0;
        gpu::Owned<VkImageView> view;
    };

    [[nodiscard]] gpu::Owned<VkImageView> make(const ResidentImageTarget& target) const;

    const gpu::Device* device_;
    std::vector<Entry> entries_;
};

}  // namespace nearfield::render
