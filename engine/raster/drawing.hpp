#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/pipeline.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <engine/raster/drawn_batch.hpp>

#include <shaders/push.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>

/// What passes that draw have in common.
namespace nearfield::raster {

/// The format of images of unsigned numbers: signs, edges, features.
inline constexpr VkFormat number_format = VK_FORMAT_R32_UINT;

/// What the passes of a tile batch are recorded from, beside the resources that they bind.
struct DrawContext {
    const DrawnBatch& batch;
    VkBuffer mesh;
    VkDeviceSize mesh_offset;       ///< of the tile batch's vertices of meshes, in bytes
    VkDeviceSize tile_mesh_offset;  ///< of its vertices with the rectangle of their tile
    std::uint32_t sample_capacity;  ///< space in the read-back, in samples
};

/// The graph of a tile batch.
using DrawGraph = graph::RecordedGraph<DrawContext>;

/// Where passes draw: into new images of one extent. All read the mesh.
struct Canvas {
    DrawGraph& graph;
    graph::Handle mesh;
    VkExtent2D extent;
};

/// Adds a pass that draws into a new image, tested against a new image of depths, stencils or both
/// (one without a format: no test). Images have the extent of the canvas. `reads`: beside the mesh.
/// Returns the new version of the former.
[[nodiscard]] graph::Handle add_drawing(const Canvas& canvas, const char* name,
                                        graph::ImageDescription image,
                                        graph::ImageDescription tested, DrawGraph::Record record,
                                        std::initializer_list<graph::Bound> reads = {});

/// A render pass with one colour and one depth-stencil image (VK_FORMAT_UNDEFINED: none), for which
/// pipelines are built. The render passes that graphs make for images of these formats are
/// compatible with it.
[[nodiscard]] gpu::Owned<VkRenderPass> make_prototype(const gpu::Device& device, VkFormat color,
                                                      VkFormat depth_stencil,
                                                      const std::string& name);

/// The description of a pipeline that draws with these shaders, without tests.
[[nodiscard]] gpu::GraphicsPipelineDescription describe_drawing(VkPipelineLayout layout,
                                                                VkRenderPass render_pass,
                                                                gpu::Spirv vertex_shader,
                                                                gpu::Spirv fragment_shader);

/// Combines colours, in some channels, with those in the image.
[[nodiscard]] VkPipelineColorBlendAttachmentState blending(VkBlendFactor source,
                                                           VkBlendFactor destination,
                                                           VkBlendOp operation,
                                                           VkColorComponentFlags channels);

/// The pipelines of a polygon fill. The low stencil bits count; the two high bits hold the parity
/// of a fill in progress.
struct StencilPipelines {
    /// `fragment_shader` writes the colour; `colors` is for the names of the pipelines.
    StencilPipelines(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass,
                     gpu::Spirv fragment_shader, const std::string& colors);

    gpu::Owned<VkPipeline> clear;   ///< stencil := reference, colour := value
    gpu::Owned<VkPipeline> parity;  ///< invert the written bits
    gpu::Owned<VkPipeline> mark;  ///< where the compared bits equal the reference: colour := value
};

namespace stencil_bits {
inline constexpr std::uint32_t all = 0xff;
inline constexpr std::uint32_t counter = 0x0f;
inline constexpr std::uint32_t parity_a = 0x40;
inline constexpr std::uint32_t parity_b = 0x80;
}  // namespace stencil_bits

/// The stages that read the push constants of a draw (shaders::MeshPush), from offset 0.
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
                 const DrawContext& context);

    void bind(VkPipeline pipeline) const;
    /// Sets the stencil state of the following draws: compare mask, write mask and reference value.
    void stencil(std::uint32_t compare_mask, std::uint32_t write_mask,
                 std::uint32_t reference) const;
    /// Draws a range of the meshes (TileMeshes::meshes). Writes the vertices' id, or `value` where
    /// ids are 0; scales depths.
    void draw(DrawRange range, float depth_scale, std::uint32_t value) const;
    /// Draws a mesh of vertices with the rectangle of their tile. Writes the vertices' id.
    void draw(TileMeshId mesh) const;

private:
    void draw_from(VkDeviceSize offset, DrawRange range, float depth_scale,
                   std::uint32_t value) const;

    const gpu::Functions* functions_;
    VkPipelineLayout layout_;
    VkCommandBuffer commands_;
    const DrawContext* context_;
};

}  // namespace nearfield::raster
