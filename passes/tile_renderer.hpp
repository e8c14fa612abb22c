#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/tile_batch.hpp>
#include <passes/record_context.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The push constants of mesh.vert, from offset 0.
inline constexpr VkShaderStageFlags draw_push_stages = VK_SHADER_STAGE_VERTEX_BIT;
inline constexpr std::uint32_t draw_push_bytes = 24;

/// The pipeline layout of graphics pipelines without resources: only push constants.
[[nodiscard]] gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device);

/// Records draws into tiles. A tile is a viewport (one pixel per cell) and a scissor rectangle.
class TileRenderer {
public:
    /// Binds the mesh of the record context.
    TileRenderer(const gpu::Device& device, VkPipelineLayout layout, VkCommandBuffer commands,
                 const RecordContext& context);

    void bind(VkPipeline pipeline) const;
    /// Sets the stencil state of the following draws: compare mask, write mask and reference value.
    void stencil(std::uint32_t compare_mask, std::uint32_t write_mask,
                 std::uint32_t reference) const;
    /// Draws a part of the mesh into a tile. Writes the vertices' id, or `value` where ids are 0.
    void draw(const plan::TileDraw& tile, plan::DrawRange range, float depth_scale,
              std::uint32_t value) const;

private:
    const gpu::Functions* functions_;
    VkPipelineLayout layout_;
    VkCommandBuffer commands_;
};

}  // namespace nearfield::passes
