#include <passes/stencil_pipelines.hpp>

#include <shaders/mesh_vert.hpp>

namespace nearfield::passes {

StencilPipelines::StencilPipelines(const gpu::Device& device, VkPipelineLayout layout,
                                   VkRenderPass render_pass, gpu::Spirv fragment_shader,
                                   const std::string& colors) {
    const auto make = [&](const std::string& name, VkCompareOp compare, VkStencilOp pass,
                          gpu::Spirv shader) {
        gpu::GraphicsPipelineDescription description;
        description.name = "nearfield " + colors + " " + name;
        description.render_pass = render_pass;
        description.layout = layout;
        description.vertex_shader = shaders::mesh_vert;
        description.fragment_shader = shader;
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

}  // namespace nearfield::passes
