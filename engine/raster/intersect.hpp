#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/raster/drawing.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::raster {

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

/// The intersection of Table 1 of the paper, by any of its strategies. A draw clears the region, B
/// changes the strategy's buffer at its samples, A changes it again, and the samples that both
/// changed are the intersection. Volumes are filled by parity first, then drawn as the region's
/// rectangle where the fill is set. Boundaries are drawn as offset polygons, which overlap each
/// other: at each sample the first of A's counts and writes its number.
///
/// An occlusion query around A's last draw into a tile is in place of the paper's min/max and
/// histogram queries (section 2.2.1). If no sample passed, the tile is not searched. The results
/// stay on the device. The plan selects the tiles (DrawnBatch::watched), which are drawn by
/// themselves. Samples that pass beside the tile count as well, which only costs the search.
class Intersect {
public:
    /// Makes the pipelines of all strategies that the device supports. `numbers`: those for
    /// number_format, built for `number_render_pass`.
    Intersect(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass number_render_pass,
              const StencilPipelines& numbers);

    /// Resets the queries; call before each tile batch, outside a render pass. All tile batches
    /// share the queries, so on the device the reset waits for the previous tile batch, also that
    /// of the previous submission.
    void reset(VkCommandBuffer commands, const DrawContext& context) const;

    /// Adds the pass that draws every overlap tile of one strategy, which the device has to
    /// support. Returns the hit image: a colour in the low byte (shaders::white: an intersection)
    /// and, if A takes part by its boundary, the number of the run of A's edges nearby
    /// (device_input::TileBatch::runs) above it.
    [[nodiscard]] graph::Handle draw(const Canvas& canvas, IntersectionStrategy strategy) const;

    /// Adds the pass that writes whether any sample passed to the summaries of a strategy's tiles
    /// (shaders::TileSummary::passed). Declare it after the pass that draws them: queries are not
    /// resources of the graph, so only the order of declaration orders the two.
    void copy_passed(DrawGraph& graph, graph::Handle& samples, IntersectionStrategy strategy) const;

private:
    [[nodiscard]] StrategySteps& add(IntersectionStrategy strategy, const char* pass_name);
    void make_stencil(const StencilPipelines& numbers);
    void make_blend();
    void make_logic_op(const StencilPipelines& numbers);
    void make_depth(const StencilPipelines& numbers);
    [[nodiscard]] gpu::GraphicsPipelineDescription description(const char* name) const;
    VkPipeline make(const gpu::GraphicsPipelineDescription& description);
    [[nodiscard]] const StrategySteps& steps(IntersectionStrategy strategy) const {
        return steps_[static_cast<std::size_t>(strategy)];
    }
    void record(VkCommandBuffer commands, const DrawContext& context,
                IntersectionStrategy strategy) const;
    void record_copies(VkCommandBuffer commands, const DrawContext& context,
                       IntersectionStrategy strategy, const gpu::BufferPart& summaries) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    VkRenderPass number_render_pass_;
    gpu::Owned<VkRenderPass> color_render_pass_;
    std::optional<StencilPipelines> colors_;
    std::vector<gpu::Owned<VkPipeline>> pipelines_;
    std::array<StrategySteps, intersection_strategies> steps_;
    gpu::Owned<VkQueryPool> queries_;
};

}  // namespace nearfield::raster
