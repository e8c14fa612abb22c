#include <engine/base/stopwatch.hpp>
#include <engine/gpu/pipeline.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace nearfield::gpu {
namespace {

// The layouts of geometry::MeshVertex and raster::TileVertex, repeated here because this module
// does not depend on theirs: position (two floats), distance (a float), id (an unsigned integer),
// and for TileVertex the rectangle of its tile (four 16-bit integers), tightly packed.
constexpr VkVertexInputBindingDescription vertex_binding{0, 16, VK_VERTEX_INPUT_RATE_VERTEX};
constexpr VkVertexInputBindingDescription tile_vertex_binding{0, 24, VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::uint32_t tile_location = 3;
constexpr std::array<VkVertexInputAttributeDescription, 4> vertex_attributes{{
    {0, 0, VK_FORMAT_R32G32_SFLOAT, 0},
    {1, 0, VK_FORMAT_R32_SFLOAT, 8},
    {2, 0, VK_FORMAT_R32_UINT, 12},
    {tile_location, 0, VK_FORMAT_R16G16B16A16_UINT, 16},
}};

constexpr std::array<VkDynamicState, 5> dynamic_states{
    VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_STENCIL_COMPARE_MASK,
    VK_DYNAMIC_STATE_STENCIL_WRITE_MASK, VK_DYNAMIC_STATE_STENCIL_REFERENCE};

// The subject of an error message. Composed before the object is made, which would leak if there
// were no memory for the text.
std::string in_words(const std::string& name) {
    return "pipeline '" + name + "'";
}

// The words to make a pipeline from: in builds that reload shaders, the reloaded version if there
// is one.
Spirv in_use([[maybe_unused]] const Device& device, Spirv built) {
#ifdef NEARFIELD_SHADER_RELOAD
    return device.shader_words().in_use(built);
#else
    return built;
#endif
}

Owned<VkShaderModule> make_shader_module(const Device& device, Spirv built,
                                         const std::string& name) {
    const Spirv shader = in_use(device, built);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = shader.size_bytes();
    info.pCode = shader.data();
    const std::string what = in_words(name);
    return make_object(device, info, what, name);
}

VkPipelineShaderStageCreateInfo shader_stage(VkShaderStageFlagBits stage,
                                             const Owned<VkShaderModule>& shader_module) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = shader_module.get();
    info.pName = "main";
    return info;
}

// The input locations that a vertex shader declares, as a bit mask. A vertex attribute that the
// shader does not use is valid, but validation layers warn about each in the host's log.
std::uint32_t input_locations(Spirv shader) {
    constexpr std::size_t header_words = 5;
    constexpr std::uint32_t op_decorate = 71;
    constexpr std::uint32_t op_variable = 59;
    constexpr std::uint32_t decoration_location = 30;
    constexpr std::uint32_t storage_class_input = 1;
    std::map<std::uint32_t, std::uint32_t> locations;  // by id; decorations precede variables
    std::uint32_t mask = 0;
    std::size_t at = header_words;
    while (at < shader.size()) {
        const std::uint32_t opcode = shader[at] & 0xFFFFU;
        const std::size_t words = std::max<std::size_t>(shader[at] >> 16U, 1);
        const Spirv operands = shader.subspan(at, std::min(words, shader.size() - at)).subspan(1);
        if (opcode == op_decorate && operands.size() == 3 && operands[1] == decoration_location) {
            locations[operands[0]] = operands[2];
        } else if (opcode == op_variable && operands.size() >= 3 &&
                   operands[2] == storage_class_input && locations.contains(operands[1])) {
            mask |= 1U << (locations[operands[1]] & 31U);
        }
        at += words;
    }
    return mask;
}

std::vector<VkVertexInputAttributeDescription> used_attributes(Spirv vertex_shader) {
    const std::uint32_t used = input_locations(vertex_shader);
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const VkVertexInputAttributeDescription& attribute : vertex_attributes) {
        if (((used >> attribute.location) & 1U) != 0) {
            attributes.push_back(attribute);
        }
    }
    return attributes;
}

VkPipelineVertexInputStateCreateInfo vertex_input_state(
    const std::vector<VkVertexInputAttributeDescription>& attributes) {
    VkPipelineVertexInputStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    info.vertexBindingDescriptionCount = attributes.empty() ? 0 : 1;
    info.pVertexBindingDescriptions =
        !attributes.empty() && attributes.back().location == tile_location ? &tile_vertex_binding
                                                                           : &vertex_binding;
    info.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    info.pVertexAttributeDescriptions = attributes.data();
    return info;
}

VkPipelineInputAssemblyStateCreateInfo triangle_lists() {
    VkPipelineInputAssemblyStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    info.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    return info;
}

VkPipelineViewportStateCreateInfo one_viewport() {
    VkPipelineViewportStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    info.viewportCount = 1;
    info.scissorCount = 1;
    return info;
}

VkPipelineRasterizationStateCreateInfo filled_triangles() {
    VkPipelineRasterizationStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.cullMode = VK_CULL_MODE_NONE;  // rings and their fans may have either winding
    info.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    info.lineWidth = 1.0F;
    return info;
}

VkPipelineMultisampleStateCreateInfo one_sample() {
    VkPipelineMultisampleStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    info.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    return info;
}

VkPipelineDepthStencilStateCreateInfo depth_stencil_state(const GraphicsPipelineDescription& what) {
    VkStencilOpState face{};
    face.failOp = VK_STENCIL_OP_KEEP;
    face.passOp = what.stencil_pass;
    face.depthFailOp = VK_STENCIL_OP_KEEP;
    face.compareOp = what.stencil_compare;
    VkPipelineDepthStencilStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    info.depthTestEnable = what.depth_test ? VK_TRUE : VK_FALSE;
    info.depthWriteEnable = info.depthTestEnable;
    info.depthCompareOp = what.depth_compare;
    info.stencilTestEnable = what.stencil_test ? VK_TRUE : VK_FALSE;
    info.front = face;
    info.back = face;
    return info;
}

VkPipelineDynamicStateCreateInfo dynamic_state() {
    VkPipelineDynamicStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    info.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    info.pDynamicStates = dynamic_states.data();
    return info;
}

VkPipelineColorBlendAttachmentState color_attachment(const GraphicsPipelineDescription& what) {
    VkPipelineColorBlendAttachmentState state{};
    if (what.blend) {
        state = *what.blend;
    } else if (!what.fragment_shader.empty()) {
        state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                               VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    }
    return state;
}

/// Owns a new pipeline, names it, and tells the host how long it took.
Owned<VkPipeline> finished(const Device& device, VkPipeline pipeline, const std::string& name,
                           const Stopwatch& start) {
    Owned<VkPipeline> owned(device, pipeline);
    device.name_object(VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    device.log(LogLevel::information, [&] {
        return "pipeline '" + name + "' made in " + std::to_string(start.milliseconds()) + " ms";
    });
    return owned;
}

}  // namespace

Owned<VkPipeline> make_compute_pipeline(const Device& device, VkPipelineLayout layout, Spirv shader,
                                        const std::string& name,
                                        std::span<const VkBool32> constants) {
    const Stopwatch start;
    const Owned<VkShaderModule> shader_module = make_shader_module(device, shader, name);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = shader_stage(VK_SHADER_STAGE_COMPUTE_BIT, shader_module);
    constexpr std::array<VkSpecializationMapEntry, 2> entries{
        {{0, 0, sizeof(VkBool32)}, {1, sizeof(VkBool32), sizeof(VkBool32)}}};
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(constants.size()),
                                              entries.data(), constants.size_bytes(),
                                              constants.data()};
    info.stage.pSpecializationInfo = constants.empty() ? nullptr : &specialization;
    info.layout = layout;
    const std::string what = in_words(name);
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.functions().vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1,
                                                      &info, device.allocator(), &pipeline),
          "vkCreateComputePipelines", what);
    return finished(device, pipeline, name, start);
}

Owned<VkPipeline> make_graphics_pipeline(const Device& device,
                                         const GraphicsPipelineDescription& what) {
    const Stopwatch start;
    const auto vertex_module = make_shader_module(device, what.vertex_shader, what.name);
    Owned<VkShaderModule> fragment_module;
    std::vector<VkPipelineShaderStageCreateInfo> stages{
        shader_stage(VK_SHADER_STAGE_VERTEX_BIT, vertex_module)};
    if (!what.fragment_shader.empty()) {
        fragment_module = make_shader_module(device, what.fragment_shader, what.name);
        stages.push_back(shader_stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_module));
    }
    const auto attributes = used_attributes(in_use(device, what.vertex_shader));
    const auto vertex_input = vertex_input_state(attributes);
    const auto input_assembly = triangle_lists();
    const auto viewport = one_viewport();
    const auto rasterization = filled_triangles();
    const auto multisample = one_sample();
    const auto depth_stencil = depth_stencil_state(what);
    const auto dynamic = dynamic_state();
    const auto blending = color_attachment(what);
    VkPipelineColorBlendStateCreateInfo color_blend{};
    color_blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    color_blend.logicOpEnable = what.logic_or ? VK_TRUE : VK_FALSE;
    color_blend.logicOp = VK_LOGIC_OP_OR;
    color_blend.attachmentCount = 1;
    color_blend.pAttachments = &blending;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &input_assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth_stencil;
    info.pColorBlendState = &color_blend;
    info.pDynamicState = &dynamic;
    info.layout = what.layout;
    info.renderPass = what.render_pass;
    const std::string words = in_words(what.name);
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device.functions().vkCreateGraphicsPipelines(device.handle(), device.pipeline_cache(), 1,
                                                       &info, device.allocator(), &pipeline),
          "vkCreateGraphicsPipelines", words);
    return finished(device, pipeline, what.name, start);
}

}  // namespace nearfield::gpu
