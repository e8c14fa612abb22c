#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/submission.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace nearfield::test_support {

/// An R32_UINT image with depth and stencil to draw on. Everything is cleared to 0, depth to 1.
class Canvas {
public:
    static constexpr std::uint32_t size = 16;  ///< pixels on each side

    explicit Canvas(const gpu::Device& device);

    [[nodiscard]] VkRenderPass render_pass() const { return render_pass_.get(); }
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }

    /// Runs `record` inside the render pass with viewport and scissor set; returns the pixels.
    std::vector<std::uint32_t> draw(const std::function<void(VkCommandBuffer)>& record);

private:
    struct Image {
        gpu::DeviceMemory memory;
        gpu::Owned<VkImage> image;
        gpu::Owned<VkImageView> view;
    };

    Image make_image(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) const;
    void make_render_pass();
    void make_framebuffer();
    void make_layout();
    void begin_render_pass(VkCommandBuffer commands) const;
    void copy_to_pixels(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    Image color_;
    Image depth_stencil_;
    gpu::Owned<VkRenderPass> render_pass_;
    gpu::Owned<VkFramebuffer> framebuffer_;
    gpu::Owned<VkPipelineLayout> layout_;
    gpu::MappedBuffer pixels_;
    gpu::Submission submission_;
};

}  // namespace nearfield::test_support
