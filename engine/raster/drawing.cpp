#include <engine/base/status_exception.hpp>
#include <engine/graph/execute.hpp>
#include <engine/raster/drawing.hpp>

#include <shaders/mesh_vert.hpp>

#include <cstddef>
#include <utility>

namespace nearfield::raster {
namespace {

// The vertex input bindings that gpu::make_graphics_pipeline declares.
static_assert(sizeof(geometry::MeshVertex) == 16 && offsetof(geometry::MeshVertex, distance) == 8 &&
              offsetof(geometry::MeshVertex, id) == 12);
static_assert(sizeof(TileVertex) == 24 && offsetof(TileVertex, x) == 16);

// The viewport holds the largest atlas in its middle, with half of its side around it: clipping
// would move edges. A pixel is a power of two in clip coordinates, so that positions on the
// sub-pixel grid reach the rasteriser without rounding.
constexpr auto viewport_side = static_cast<float>(2 * queries::largest_atlas_side);
constexpr float viewport_origin = -0.25F * viewport_side;
constexpr VkViewport viewport{
    viewport_origin, viewport_origin, viewport_side, viewport_side, 0.0F, 1.0F};
constexpr float scale = 2.0F / viewport_side;
constexpr float bias = -scale * viewport_origin - 1.0F;

}  // namespace

graph::Handle add_drawing(const Canvas& canvas, const char* name, graph::ImageDescription image,
                          graph::ImageDescription tested, DrawGraph::Record record,
                          std::initializer_list<graph::Bound> reads) {
    image.extent = tested.extent = canvas.extent;
    graph::Handle drawn = canvas.graph.create_image(std::move(image));
    canvas.graph.add_pass(
        name, graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(canvas.mesh, graph::Access::vertex_buffer);
            pass.use(reads);
            drawn = pass.write(drawn, graph::Access::color_attachment);
            if (tested.format != VK_FORMAT_UNDEFINED) {
                static_cast<void>(pass.write(canvas.graph.create_image(std::move(tested)),
                                             graph::Access::depth_stencil_attachment));
            }
        },
        std::move(record));
    return drawn;
}

gpu::Owned<VkRenderPass> make_prototype(const gpu::Device& device, VkFormat color,
                                        VkFormat depth_stencil, const std::string& name) {
    graph::Graph graph;
    const graph::Handle colors = graph.create_image({"prototype colour", color, {1, 1}});
    graph.add_pass(name + " prototype", graph::PassKind::graphics, [&](graph::PassBuilder& pass) {
        static_cast<void>(pass.write(colors, graph::Access::color_attachment));
        if (depth_stencil != VK_FORMAT_UNDEFINED) {
            const graph::Handle depth =
                graph.create_image({"prototype depth", depth_stencil, {1, 1}});
            static_cast<void>(pass.write(depth, graph::Access::depth_stencil_attachment));
        }
    });
    const Expected<graph::BakedGraph> baked = graph::bake(graph);
    if (!baked) {
        throw StatusException(baked.error());
    }
    return graph::make_render_pass(device, graph, baked->passes.front());
}

gpu::GraphicsPipelineDescription describe_drawing(VkPipelineLayout layout, VkRenderPass render_pass,
                                                  gpu::Spirv vertex_shader,
                                                  gpu::Spirv fragment_shader) {
    gpu::GraphicsPipelineDescription description;
    description.render_pass = render_pass;
    description.layout = layout;
    description.vertex_shader = vertex_shader;
    description.fragment_shader = fragment_shader;
    return description;
}

VkPipelineColorBlendAttachmentState blending(VkBlendFactor source, VkBlendFactor destination,
                                             VkBlendOp operation, VkColorComponentFlags channels) {
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = VK_TRUE;
    blend.srcColorBlendFactor = blend.srcAlphaBlendFactor = source;
    blend.dstColorBlendFactor = blend.dstAlphaBlendFactor = destination;
    blend.colorBlendOp = blend.alphaBlendOp = operation;
    blend.colorWriteMask = channels;
    return blend;
}

StencilPipelines::StencilPipelines(const gpu::Device& device, VkPipelineLayout layout,
                                   VkRenderPass render_pass, gpu::Spirv fragment_shader,
                                   const std::string& colors) {
    const auto make = [&](const std::string& name, VkCompareOp compare, VkStencilOp pass,
                          gpu::Spirv shader) {
        gpu::GraphicsPipelineDescription description =
            describe_drawing(layout, render_pass, shaders::mesh_vert, shader);
        description.name = "nearfield " + colors + " " + name;
        description.stencil_test = true;
        description.stencil_compare = compare;
        description.stencil_pass = pass;
        return gpu::make_graphics_pipeline(device, description);
    };
    const gpu::Spirv none;
    clear = make("clear", VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_REPLACE, fragment_shader);
    parity = make("parity", VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_INVERT, none);
    mark = make("mark", VK_COMPARE_OP_EQUAL, VK_STENCIL_OP_KEEP, fragment_shader);
}

gpu::Owned<VkPipelineLayout> make_draw_layout(const gpu::Device& device) {
    const VkPushConstantRange push{draw_push_stages, 0, sizeof(shaders::MeshPush)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    return gpu::make_object(device, info, "the layout of all draws", "nearfield draw layout");
}

TileRenderer::TileRenderer(const gpu::Device& device, VkPipelineLayout layout,
                           VkCommandBuffer commands, const DrawContext& context)
    : functions_(&device.functions()), layout_(layout), commands_(commands), context_(&context) {
    const TileSize extent = context.batch.extent;
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

void TileRenderer::draw(DrawRange range, float depth_scale, std::uint32_t value) const {
    draw_from(context_->mesh_offset, range, depth_scale, value);
}

void TileRenderer::draw(TileMeshId mesh) const {
    draw_from(context_->tile_mesh_offset, context_->batch.meshes.range(mesh), 1.0F, 0);
}

void TileRenderer::draw_from(VkDeviceSize offset, DrawRange range, float depth_scale,
                             std::uint32_t value) const {
    if (range.count == 0) {
        return;
    }
    functions_->vkCmdBindVertexBuffers(commands_, 0, 1, &context_->mesh, &offset);
    const shaders::MeshPush push{{scale, scale}, {bias, bias}, depth_scale, value};
    functions_->vkCmdPushConstants(commands_, layout_, draw_push_stages, 0, sizeof(push), &push);
    functions_->vkCmdDraw(commands_, range.count, 1, range.first, 0);
}

}  // namespace nearfield::raster
