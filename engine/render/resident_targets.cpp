#include <engine/base/unique_numbers.hpp>
#include <engine/render/resident_targets.hpp>

namespace nearfield::render {
namespace {

graph::ExternalUse use_of(const TargetState& state) {
    return {state.stages, state.access, state.layout};
}

}  // namespace

// Another image or buffer of the host's may have the handle of one that is gone, so each time
// counts as new.
graph::ImportedImage imported_image(const ImageTarget& target, VkImage own, VkImageView view,
                                    std::uint64_t identity) {
    if (target.image == VK_NULL_HANDLE) {
        return {.image = own, .view = view, .identity = identity};
    }
    return {target.image, target.level,
            target.layer, graph::ExternalUses{use_of(target.before), use_of(target.after)},
            view,         next_revision()};
}

gpu::BufferPart range_of_target(const BufferTarget& target, const gpu::BufferPart& own) {
    return target.buffer == VK_NULL_HANDLE
               ? own
               : gpu::BufferPart{target.buffer, target.offset, own.bytes, VK_NULL_HANDLE,
                                 next_revision()};
}

std::optional<graph::ExternalUses> uses_of(const BufferTarget& target) {
    if (target.buffer == VK_NULL_HANDLE) {
        return std::nullopt;
    }
    return graph::ExternalUses{use_of(target.before), use_of(target.after)};
}

}  // namespace nearfield::render
