#include <passes/drawing.hpp>
#include <passes/stencil_pipelines.hpp>

#include <shaders/mesh_vert.hpp>

namespace nearfield::passes {

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

}  // namespace nearfield::passes
