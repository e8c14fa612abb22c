#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <string>

namespace nearfield::passes {

/// A render pass with one colour and one depth-stencil image (VK_FORMAT_UNDEFINED: none), for which
/// pipelines are built. The render passes that graphs make for images of these formats are
/// compatible with it.
[[nodiscard]] gpu::Owned<VkRenderPass> make_prototype(const gpu::Device& device, VkFormat color,
                                                      VkFormat depth_stencil,
                                                      const std::string& name);

}  // namespace nearfield::passes
