#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>

namespace nearfield::gpu {

/// Sets the sharing mode of a buffer or image to be created: concurrent between these queue
/// families if there are several, otherwise exclusive. The families are borrowed.
template <class CreateInfo>
void share(CreateInfo& info, std::span<const std::uint32_t> families) {
    info.sharingMode = families.size() > 1 ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
    info.queueFamilyIndexCount = static_cast<std::uint32_t>(families.size());
    info.pQueueFamilyIndices = families.data();
}

}  // namespace nearfield::gpu
