#include <passes/tile_renderer.hpp>

#include <cstddef>

namespace nearfield::passes {
namespace {

// The vertex input bindings that gpu::make_graphics_pipeline declares.
static_assert(sizeof(geometry::MeshVertex) == 16 && offsetof(geometry::MeshVertex, distance) == 8 &&
              offsetof(geometry::MeshVertex, id) == 12);
static_assert(sizeof(plan::TileVertex) == 24 && offsetof(plan::TileVertex, x) == 16);

// The viewport holds the largest atlas in its middle, with half of its side around it: clipping
// would move edges. A pixel is a power of two in clip coordinates, so that positions on the
// sub-pixel grid reach the rasteriser without rounding.
constexpr auto viewport_side = static_cast<float>(2 * plan::largest_atlas_side);
constexpr float viewport_origin = -0.25F * viewport_side;
constexpr VkViewport viewport{
    viewport_origin, viewport_origin, viewport_side, viewport_side, 0.0F, 1.0F};
constexpr float scale = 2.0F / viewport_side;
constexpr float bias = -scale * viewport_origin - 1.0F;

}  // namespace

gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device) {
    const VkPushConstantRange push{draw_push_stages, 0, sizeof(plan::MeshPush)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    return gpu::make_object(device, info, "the layout of all draws", "nearfield draw layout");
}

TileRenderer::TileRenderer(const gpu::Device& device, VkPipelineLayout layout,
                           VkCommandBuffer commands, const RecordContext& context)
    : functions_(&device.functions()), layout_(layout), commands_(commands), context_(&context) {
    const plan::TileSize extent = context.batch.raster.extent;
    const VkRect2D scissor{{0, 0}, {extent.width, extent.height}};
    functions_->vkCmdSetViewport(commands_, 0, 1, &viewport);
    functions_->vkCmdSetScissor(commands_, 0, 1, &scissor);
}

void TileRenderer::bind(VkPipeline pipeline) const {
    functions_->vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
}

void TileRenderer::stencil(std::uint32_t compare_mask, std::uint32_t write_mask,
                           std::uint32_t reference) const {
    const VkStencilFaceFlags faces = VK_STENCIL_FACE_FRONT_AND_BACK;
    functions_->vkCmdSetStencilCompareMask(commands_, faces, compare_mask);
    functions_->vkCmdSetStencilWriteMask(commands_, faces, write_mask);
    functions_->vkCmdSetStencilReference(commands_, faces, reference);
}

void TileRenderer::draw(plan::DrawRange range, float depth_scale, std::uint32_t value) const {
    draw_from(context_->mesh_offset, range, depth_scale, value);
}

void TileRenderer::draw(plan::TileMeshId mesh) const {
    draw_from(context_->tile_mesh_offset, context_->batch.raster.meshes.range(mesh), 1.0F, 0);
}

void TileRenderer::draw_from(VkDeviceSize offset, plan::DrawRange range, float depth_scale,
                             std::uint32_t value) const {
    if (range.count == 0) {
        return;
    }
    functions_->vkCmdBindVertexBuffers(commands_, 0, 1, &context_->mesh, &offset);
    const plan::MeshPush push{{scale, scale}, {bias, bias}, depth_scale, value};
    functions_->vkCmdPushConstants(commands_, layout_, draw_push_stages, 0, sizeof(push), &push);
    functions_->vkCmdDraw(commands_, range.count, 1, range.first, 0);
}

}  // namespace nearfield::passes
