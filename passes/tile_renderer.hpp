#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/tile_batch.hpp>
#include <passes/record_context.hpp>

#include <shaders/push.h>

#include <cstdint>

namespace nearfield::passes {

/// The stages that read the push constants of a draw (plan::MeshPush), from offset 0.
inline constexpr VkShaderStageFlags draw_push_stages = VK_SHADER_STAGE_VERTEX_BIT;

/// The pipeline layout of graphics pipelines without resources: only push constants.
[[nodiscard]] gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device);

/// Records draws, each into all tiles that its mesh has triangles for. One viewport, in which a
/// pixel is a cell, serves all tiles. What keeps triangles out of other tiles is their distance in
/// the atlas, or the rectangle that each vertex carries.
class TileRenderer {
public:
    /// Sets the viewport, and as scissor rectangle what the tiles of the tile batch take.
    TileRenderer(const gpu::Device& device, VkPipelineLayout layout, VkCommandBuffer commands,
                 const RecordContext& context);

    void bind(VkPipeline pipeline) const;
    /// Sets the stencil state of the following draws: compare mask, write mask and reference value.
    void stencil(std::uint32_t compare_mask, std::uint32_t write_mask,
                 std::uint32_t reference) const;
    /// Draws a range of the meshes (TileMeshes::meshes). Writes the vertices' id, or `value` where
    /// ids are 0; scales depths.
    void draw(plan::DrawRange range, float depth_scale, std::uint32_t value) const;
    /// Draws a mesh of vertices with the rectangle of their tile. Writes the vertices' id.
    void draw(plan::TileMeshId mesh) const;

private:
    void draw_from(VkDeviceSize offset, plan::DrawRange range, float depth_scale,
                   std::uint32_t value) const;

    const gpu::Functions* functions_;
    VkPipelineLayout layout_;
    VkCommandBuffer commands_;
    const RecordContext* context_;
};

}  // namespace nearfield::passes
