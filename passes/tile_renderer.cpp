#include <passes/tile_renderer.hpp>

#include <cstddef>

namespace nearfield::passes {
namespace {

/// The push constants of mesh.vert.
struct Push {
    float scale[2];
    float bias[2];
    float depth_scale;
    std::uint32_t value;
};
static_assert(offsetof(Push, value) == 20 && sizeof(Push) == draw_push_bytes);

// The vertex input binding that gpu::make_graphics_pipeline declares.
static_assert(sizeof(geometry::MeshVertex) == 16 && offsetof(geometry::MeshVertex, distance) == 8 &&
              offsetof(geometry::MeshVertex, id) == 12);

// Meshes reach up to two cells outside their tile. The viewport holds them completely, so the
// rasteriser does not clip, which would move edges; the scissor rectangle cuts off the outside.
constexpr float viewport_border = 4.0F;

}  // namespace

gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device) {
    const VkPushConstantRange push{draw_push_stages, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    gpu::check(device.functions().vkCreatePipelineLayout(device.handle(), &info, device.allocator(),
                                                         &layout),
               "vkCreatePipelineLayout", "the layout of all draws");
    gpu::Owned<VkPipelineLayout> owned(device, layout);
    device.name_object(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout, "nearfield draw layout");
    return owned;
}

TileRenderer::TileRenderer(const gpu::Device& device, VkPipelineLayout layout,
                           VkCommandBuffer commands, const RecordContext& context)
    : functions_(&device.functions()), layout_(layout), commands_(commands) {
    functions_->vkCmdBindVertexBuffers(commands_, 0, 1, &context.mesh, &context.mesh_offset);
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

void TileRenderer::draw(const plan::TileDraw& tile, plan::DrawRange range, float depth_scale,
                        std::uint32_t value) const {
    if (range.count == 0) {
        return;
    }
    const auto x = static_cast<float>(tile.x);
    const auto y = static_cast<float>(tile.y);
    const float width = static_cast<float>(tile.width) + 2.0F * viewport_border;
    const float height = static_cast<float>(tile.height) + 2.0F * viewport_border;
    const VkViewport viewport{x - viewport_border, y - viewport_border, width, height, 0.0F, 1.0F};
    const VkRect2D scissor{{static_cast<std::int32_t>(tile.x), static_cast<std::int32_t>(tile.y)},
                           {tile.width, tile.height}};
    functions_->vkCmdSetViewport(commands_, 0, 1, &viewport);
    functions_->vkCmdSetScissor(commands_, 0, 1, &scissor);
    const Push push{{2.0F / width, 2.0F / height},
                    {2.0F * viewport_border / width - 1.0F, 2.0F * viewport_border / height - 1.0F},
                    depth_scale,
                    value};
    functions_->vkCmdPushConstants(commands_, layout_, draw_push_stages, 0, sizeof(push), &push);
    functions_->vkCmdDraw(commands_, range.count, 1, range.first, 0);
}

}  // namespace nearfield::passes
