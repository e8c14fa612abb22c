#include <engine/render/target_views.hpp>

namespace nearfield::render {

VkImageView TargetViews::of(const ResidentImageTarget& target) {
    for (const Entry& entry : entries_) {
        if (entry.image == target.image && entry.format == target.format &&
            entry.level == target.level && entry.layer == target.layer) {
            return entry.view.get();
        }
    }
    entries_.push_back({target.image, target.format, target.level, target.layer, make(target)});
    return entries_.back().view.get();
}

void TargetViews::release(VkImage image) {
    std::erase_if(entries_, [image](const Entry& entry) { return entry.image == image; });
}

gpu::Owned<VkImageView> TargetViews::make(const ResidentImageTarget& target) const {
    constexpr const char* name = "nearfield view of the host's image";
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = target.image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = target.format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, target.level, 1, target.layer, 1};
    return gpu::make_object(*device_, info, name, name);
}

}  // namespace nearfield::render
