#include <passes/drawing.hpp>

#include <utility>

namespace nearfield::passes {

graph::Handle add_drawing(TileGraph& graph, const char* name,
                          std::initializer_list<graph::Bound> reads, graph::ImageDescription image,
                          graph::ImageDescription tested, TileGraph::Record record) {
    graph::Handle drawn = graph.create_image(std::move(image));
    graph.add_pass(
        name, graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.use(reads);
            drawn = pass.write(drawn, graph::Access::color_attachment);
            if (tested.format != VK_FORMAT_UNDEFINED) {
                static_cast<void>(pass.write(graph.create_image(std::move(tested)),
                                             graph::Access::depth_stencil_attachment));
            }
        },
        std::move(record));
    return drawn;
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

}  // namespace nearfield::passes
