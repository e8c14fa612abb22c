#pragma once

#include "picture.hpp"
#include "resources.hpp"

#include <span>
#include <vector>

namespace nearfield::examples {

/// A Vulkan renderer in small: coloured triangles in pixels, one pipeline, a vertex buffer for each
/// frame in flight.
class Painter {
public:
    /// Draws in the first subpass of `render_pass`, or of one compatible with it: one colour
    /// attachment, one sample a pixel, with or without depth (which is left alone).
    Painter(VkPhysicalDevice physical_device, VkDevice device, VkRenderPass render_pass,
            std::uint32_t frames_in_flight);

    /// Copies the triangles to a frame's slot, whose former frame the device is done with.
    void upload(std::uint32_t slot, std::span<const Vertex> triangles);
    /// Draws what was uploaded last to the slot; inside the render pass.
    void draw(VkCommandBuffer commands, std::uint32_t slot, VkExtent2D extent) const;

private:
    struct Slot {
        HostBuffer vertices;
        std::uint32_t count = 0;
    };

    VkPhysicalDevice physical_device_;
    VkDevice device_;
    PipelineLayout layout_;
    Pipeline pipeline_;
    std::vector<Slot> slots_;
};

}  // namespace nearfield::examples
