#pragma once

#include "picture.hpp"
#include "resources.hpp"

#include <span>
#include <vector>

namespace nearfield::examples {

/// A minimal Vulkan renderer: coloured triangles in pixels, one pipeline, a vertex buffer for each
/// frame in flight.
class Painter {
public:
    /// Draws in the first subpass of `render_pass`, or of a compatible one: one colour attachment,
    /// one sample per pixel, with or without depth (which is not used).
    Painter(vk::PhysicalDevice physical_device, vk::Device device, vk::RenderPass render_pass,
            std::uint32_t frames_in_flight);

    /// Copies the triangles to a slot. Precondition: the device has finished the slot's previous
    /// frame.
    void upload(std::uint32_t slot, std::span<const Vertex> triangles);

    /// Draws the slot's last upload. Call inside the render pass.
    void draw(vk::CommandBuffer commands, std::uint32_t slot, vk::Extent2D extent) const;

private:
    struct Slot {
        HostBuffer vertices;
        std::uint32_t count = 0;
    };

    vk::PhysicalDevice physical_device_;
    vk::Device device_;
    vk::UniquePipelineLayout layout_;
    vk::UniquePipeline pipeline_;
    std::vector<Slot> slots_;
};

}  // namespace nearfield::examples
