#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/round.hpp>
#include <passes/frame.hpp>

#include <cstdint>

namespace nearfield::passes {

/// What mesh.vert takes as push constants, from offset 0.
inline constexpr VkShaderStageFlags draw_push_stages = VK_SHADER_STAGE_VERTEX_BIT;
inline constexpr std::uint32_t draw_push_bytes = 24;

/// The pipeline layout of graphics pipelines without resources: push constants only.
[[nodiscard]] gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device);

/// Records draws into tiles: a tile is a viewport (cells to pixels, one to one) and a scissor.
class TileRenderer {
public:
    /// Binds the frame's mesh.
    TileRenderer(const gpu::Device& device, VkPipelineLayout layout, VkCommandBuffer commands,
                 const Frame& frame);

    void bind(VkPipeline pipeline) const;
    /// Stencil state for the following draws: which bits are compared, which are written, and the
    /// reference value.
    void stencil(std::uint32_t compare_mask, std::uint32_t write_mask,
                 std::uint32_t reference) const;
    /// Draws a part of the mesh into a tile. What is written is a vertex's id, or `value` where
    /// ids are 0.
    void draw(const plan::TileDraw& tile, plan::DrawRange range, float depth_scale,
              std::uint32_t value) const;

private:
    const gpu::Functions* functions_;
    VkPipelineLayout layout_;
    VkCommandBuffer commands_;
};

}  // namespace nearfield::passes
