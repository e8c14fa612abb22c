#include <engine/gpu/pipeline.hpp>
#include <passes/stencil_pipelines.hpp>

#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>

#include <string>

namespace nearfield::passes {

StencilPipelines::StencilPipelines(const gpu::Device& device, VkPipelineLayout layout,
                                   VkRenderPass render_pass) {
    const auto make = [&](const std::string& name, VkCompareOp compare, VkStencilOp pass,
                          gpu::Spirv fragment_shader) {
        gpu::GraphicsPipelineDescription description;
        description.name = "nearfield stencil " + name;
        description.render_pass = render_pass;
        description.layout = layout;
        description.vertex_shader = shaders::mesh_vert;
        description.fragment_shader = fragment_shader;
        description.stencil_test = true;
        description.stencil_compare = compare;
        description.stencil_pass = pass;
        return gpu::make_graphics_pipeline(device, description);
    };
    const gpu::Spirv none;
    const gpu::Spirv number = shaders::number_frag;
    clear = make("clear", VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_REPLACE, number);
    parity = make("parity", VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_INVERT, none);
    set = make("set", VK_COMPARE_OP_ALWAYS, VK_STENCIL_OP_REPLACE, none);
    count = make("count", VK_COMPARE_OP_EQUAL, VK_STENCIL_OP_INCREMENT_AND_CLAMP, none);
    mark = make("mark", VK_COMPARE_OP_EQUAL, VK_STENCIL_OP_KEEP, number);
    hit = make("hit", VK_COMPARE_OP_EQUAL, VK_STENCIL_OP_INCREMENT_AND_CLAMP, number);
}

}  // namespace nearfield::passes
