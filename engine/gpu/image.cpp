#include <engine/gpu/image.hpp>
#include <engine/gpu/sharing.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::gpu {

Owned<VkImage> make_image(const Device& device, VkFormat format, VkExtent2D extent,
                          VkImageUsageFlags usage, const std::string& name,
                          VkImageCreateFlags flags, std::span<const std::uint32_t> families) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = flags;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    share(info, families);
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    return make_object(device, info, name, name);
}

Owned<VkImageView> make_view(const Device& device, VkImage image, VkFormat format,
                             VkImageAspectFlags aspects, const std::string& name) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspects, 0, 1, 0, 1};
    return make_object(device, info, name, name);
}

KeptImage::KeptImage(const Device& device, VkFormat format, std::string name)
    : device_(&device), format_(format), name_(std::move(name)) {}

bool KeptImage::reserve(VkExtent2D extent) {
    extent = {std::max(extent.width, extent_.width), std::max(extent.height, extent_.height)};
    if (extent.width == extent_.width && extent.height == extent_.height) {
        return false;
    }
    // Free the former image first, so that both never occupy memory at the same time.
    extent_ = {};
    view_.reset();
    image_.reset();
    memory_.reset();
    try {
        image_ = make_image(*device_, format_, extent,
                            VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                            name_, 0, device_->reader_families());
        allocate_memory();
        view_ = make_view(*device_, image_.get(), format_, VK_IMAGE_ASPECT_COLOR_BIT, name_);
    } catch (...) {
        image_.reset();
        memory_.reset();
        throw;
    }
    extent_ = extent;
    return true;
}

void KeptImage::allocate_memory() {
    const Functions& functions = device_->functions();
    VkMemoryRequirements needs{};
    functions.vkGetImageMemoryRequirements(device_->handle(), image_.get(), &needs);
    memory_ = device_->memory().allocate(needs, {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT},
                                         MemoryKind::image, name_);
    check(functions.vkBindImageMemory(device_->handle(), image_.get(), memory_.get(),
                                      memory_.offset()),
          "vkBindImageMemory", name_);
}

}  // namespace nearfield::gpu
