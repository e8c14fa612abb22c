#pragma once

#include <nearfield/vulkan.hpp>

#include <tests/support/host_gpu.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {

/// A picture drawn by a host, from the top row down.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 4>> pixels;

    [[nodiscard]] const std::array<std::uint8_t, 4>& at(std::uint32_t column,
                                                        std::uint32_t row) const {
        return pixels[std::size_t{row} * width + column];
    }
    /// As a portable pixmap.
    void write(const std::string& path) const;
};

/// A host's own renderer: a render pass and three pipelines whose shaders read nearfield's resident
/// outputs. It does not use the results on the CPU.
class ResidentView {
public:
    ResidentView(const HostDevice& host, VkExtent2D pixels);

    struct Shot {
        Vector2 low;                ///< of the picture, world coordinates
        double step = 0.0;          ///< world units per pixel
        double arrow_length = 0.0;  ///< world units
        double line_spacing = 0.0;
    };
    /// The outputs to draw.
    struct Subject {
        FieldOnDevice field;
        PointsOnDevice contacts;
        SamplesOnDevice overlap;
    };
    [[nodiscard]] Picture draw(const Subject& subject, const Shot& shot);

private:
    void make_render_pass();
    void make_target();
    void make_layout();
    void make_set();
    [[nodiscard]] VkPipeline make_pipeline(std::span<const std::uint32_t> vertex,
                                           std::span<const std::uint32_t> fragment,
                                           bool per_sample = false);
    void bind(const Subject& subject) const;
    void record(VkCommandBuffer commands, const Subject& subject, const Shot& shot) const;
    void record_copy(VkCommandBuffer commands) const;

    test_support::HostGpu gpu_;
    VkExtent2D extent_;
    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    test_support::HostGpu::Image target_;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipeline field_pipeline_ = VK_NULL_HANDLE;
    VkPipeline samples_pipeline_ = VK_NULL_HANDLE;
    VkPipeline arrows_pipeline_ = VK_NULL_HANDLE;
    test_support::HostGpu::Buffer pixels_;
};

}  // namespace nearfield::test
