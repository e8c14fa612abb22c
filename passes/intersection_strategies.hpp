#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/query.hpp>
#include <passes/stencil_pipelines.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::passes {

/// A row of Table 1 of the paper as draws. All strategies draw the same geometry in the same order
/// (see Intersect), and the final colour is white where both shapes are. They differ in the buffer
/// that decides it.
struct StrategySteps {
    const char* pass_name = "";
    VkFormat color_format = VK_FORMAT_UNDEFINED;
    VkPipeline clear = VK_NULL_HANDLE;   ///< the region: stencil 0, colour 0, depth 1
    VkPipeline parity = VK_NULL_HANDLE;  ///< fill of a volume, before it is drawn
    VkPipeline b = VK_NULL_HANDLE;       ///< B's samples; a second draw of a sample changes nothing
    VkPipeline a = VK_NULL_HANDLE;       ///< A's samples, each once: counted in the stencil
    std::uint32_t value_b = 0;           ///< colour of B
    std::uint32_t value_a = 0;           ///< colour of A
    float depth_b = 1.0F;
    float depth_a = 1.0F;
    std::uint32_t count_b = 0;  ///< stencil count at B's samples before A is drawn
};

/// The pipelines of all strategies that the device supports.
class IntersectionStrategies {
public:
    /// `numbers`: the pipelines for number_format, built for `number_render_pass`.
    IntersectionStrategies(const gpu::Device& device, VkPipelineLayout layout,
                           VkRenderPass number_render_pass, const StencilPipelines& numbers);

    /// Precondition: the device supports the strategy.
    [[nodiscard]] const StrategySteps& steps(IntersectionStrategy strategy) const {
        return steps_[static_cast<std::size_t>(strategy)];
    }

private:
    StrategySteps& add(IntersectionStrategy strategy, const char* pass_name);
    void make_stencil(const StencilPipelines& numbers);
    void make_blend();
    void make_logic_op(const StencilPipelines& numbers);
    void make_depth(const StencilPipelines& numbers);
    [[nodiscard]] gpu::GraphicsPipelineDescription description(const char* name) const;
    VkPipeline make(const gpu::GraphicsPipelineDescription& description);

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    VkRenderPass number_render_pass_;
    gpu::Owned<VkRenderPass> color_render_pass_;
    std::optional<StencilPipelines> colors_;
    std::vector<gpu::Owned<VkPipeline>> pipelines_;
    std::array<StrategySteps, intersection_strategies> steps_;
};

}  // namespace nearfield::passes
