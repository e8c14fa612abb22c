#pragma once

#include <engine/base/unique_numbers.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/graph/execute.hpp>
#include <nearfield/on_device.hpp>

#include <optional>

namespace nearfield::render {

/// What the host states about an image or buffer of its own, for the render graph.
[[nodiscard]] inline graph::ExternalUse use_of(const TargetState& state) {
    return {state.stages, state.access, state.layout};
}

/// The host's uses of its buffer; nothing of one that is nearfield's own.
[[nodiscard]] inline std::optional<graph::ExternalUses> uses_of(const BufferTarget& target) {
    if (target.buffer == VK_NULL_HANDLE) {
        return std::nullopt;
    }
    return graph::ExternalUses{use_of(target.before), use_of(target.after)};
}

/// Of the host's buffer. Another one may have the handle of one that is gone, so each time counts
/// as new.
[[nodiscard]] inline gpu::BufferPart part_of(const BufferTarget& target, VkDeviceSize offset,
                                             VkDeviceSize bytes) {
    return {target.buffer, offset, bytes, VK_NULL_HANDLE, next_revision()};
}

/// Where the header goes. Precondition: the host has a place for it.
[[nodiscard]] inline gpu::BufferPart header_part_of(const BufferTarget& target) {
    return part_of(target, *target.header_offset, sizeof(HeaderData));
}

}  // namespace nearfield::render
