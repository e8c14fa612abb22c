#include <passes/drawing.hpp>
#include <passes/intersection_strategies.hpp>
#include <passes/prototype.hpp>

#include <shaders/color_frag.hpp>
#include <shaders/layout.h>
#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>

namespace nearfield::passes {

IntersectionStrategies::IntersectionStrategies(const gpu::Device& device, VkPipelineLayout layout,
                                               VkRenderPass number_render_pass,
                                               const StencilPipelines& numbers)
    : device_(&device), layout_(layout), number_render_pass_(number_render_pass) {
    const auto available = [&](IntersectionStrategy strategy) {
        return gpu::missing_for(strategy, device.strategy_support()).empty();
    };
    make_stencil(numbers);
    make_depth(numbers);
    if (available(IntersectionStrategy::blend)) {
        make_blend();
    }
    if (available(IntersectionStrategy::logic_op)) {
        make_logic_op(numbers);
    }
}

/// Writes the colour where the compared stencil bits equal the reference.
gpu::GraphicsPipelineDescription IntersectionStrategies::description(const char* name) const {
    gpu::GraphicsPipelineDescription description =
        describe_drawing(layout_, number_render_pass_, shaders::mesh_vert, shaders::number_frag);
    description.name = name;
    description.stencil_test = true;
    description.stencil_compare = VK_COMPARE_OP_EQUAL;
    return description;
}

VkPipeline IntersectionStrategies::make(const gpu::GraphicsPipelineDescription& description) {
    return pipelines_.emplace_back(gpu::make_graphics_pipeline(*device_, description)).get();
}

StrategySteps& IntersectionStrategies::add(IntersectionStrategy strategy, const char* pass_name) {
    StrategySteps& steps = steps_[static_cast<std::size_t>(strategy)];
    steps.pass_name = pass_name;
    steps.color_format = number_format;
    return steps;
}

/// B counts to 1; A counts from 1 to 2 and writes white.
void IntersectionStrategies::make_stencil(const StencilPipelines& numbers) {
    StrategySteps& steps = add(IntersectionStrategy::stencil, "intersect by stencil");
    steps.clear = numbers.clear.get();
    steps.parity = numbers.parity.get();
    auto count = description("nearfield stencil count");
    count.fragment_shader = {};
    count.stencil_pass = VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    steps.b = make(count);
    auto hit = description("nearfield stencil hit");
    hit.stencil_pass = VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    steps.a = make(hit);
    steps.value_a = plan::white;
    steps.count_b = 1;
}

/// 128 + 127 = 255. The edge's number is in the other three bytes: 0 + byte.
void IntersectionStrategies::make_blend() {
    color_render_pass_ =
        make_prototype(*device_, gpu::blend_format, device_->stencil_format(), "blend");
    colors_.emplace(*device_, layout_, color_render_pass_.get(), shaders::color_frag, "blend");
    StrategySteps& steps = add(IntersectionStrategy::blend, "intersect by blend");
    steps.color_format = gpu::blend_format;
    steps.clear = colors_->clear.get();
    steps.parity = colors_->parity.get();
    steps.b = colors_->mark.get();
    auto sum = description("nearfield blend add");
    sum.render_pass = color_render_pass_.get();
    sum.fragment_shader = shaders::color_frag;
    sum.stencil_pass = VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    sum.blend = blending(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE, VK_BLEND_OP_ADD,
                         VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                             VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT);
    steps.a = make(sum);
    steps.value_b = 128;
    steps.value_a = 127;
}

/// 127 | 128 = 255. The edge's number is in the bits above: 0 | number.
void IntersectionStrategies::make_logic_op(const StencilPipelines& numbers) {
    StrategySteps& steps = add(IntersectionStrategy::logic_op, "intersect by logic op");
    steps.clear = numbers.clear.get();
    steps.parity = numbers.parity.get();
    steps.b = numbers.mark.get();
    auto combine = description("nearfield logic op or");
    combine.stencil_pass = VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    combine.logic_or = true;
    steps.a = make(combine);
    steps.value_b = 127;
    steps.value_a = 128;
}

/// B sets depth 0; A writes white where the depth equals 0.
void IntersectionStrategies::make_depth(const StencilPipelines& numbers) {
    StrategySteps& steps = add(IntersectionStrategy::depth, "intersect by depth");
    auto clear = description("nearfield depth clear");
    clear.stencil_compare = VK_COMPARE_OP_ALWAYS;
    clear.stencil_pass = VK_STENCIL_OP_REPLACE;
    clear.depth_test = true;
    clear.depth_compare = VK_COMPARE_OP_ALWAYS;
    steps.clear = make(clear);
    steps.parity = numbers.parity.get();
    auto lower = description("nearfield depth lower");
    lower.fragment_shader = {};
    lower.depth_test = true;
    lower.depth_compare = VK_COMPARE_OP_ALWAYS;
    steps.b = make(lower);
    auto equal = description("nearfield depth equal");
    equal.stencil_pass = VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    equal.depth_test = true;
    equal.depth_compare = VK_COMPARE_OP_EQUAL;
    steps.a = make(equal);
    steps.value_a = plan::white;
    steps.depth_b = 0.0F;
    steps.depth_a = 0.0F;
}

}  // namespace nearfield::passes
