#pragma once

#include <engine/gpu/device.hpp>

#include <shaders/search.h>
#include <vulkan/vulkan_core.h>

namespace nearfield::passes {

/// Whether shaders read the input of a search as texels: where these can address as much as a
/// storage buffer.
[[nodiscard]] inline VkBool32 reads_texels(const gpu::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    return limits.maxTexelBufferElements >= limits.maxStorageBufferRange / plan::bytes_of_unit
               ? VK_TRUE
               : VK_FALSE;
}

}  // namespace nearfield::passes
