#include <engine/raster/intersect.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/color_frag.hpp>
#include <shaders/layout.h>
#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::raster {

using device_input::Part;

Intersect::Intersect(const gpu::Device& device, VkPipelineLayout layout,
                     VkRenderPass number_render_pass, const StencilPipelines& numbers)
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
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = max_watched;
    queries_ = gpu::make_object(device, info, "the occlusion queries of intersections",
                                "nearfield occlusion queries");
}

/// Writes the colour where the compared stencil bits equal the reference.
gpu::GraphicsPipelineDescription Intersect::description(const char* name) const {
    gpu::GraphicsPipelineDescription description =
        describe_drawing(layout_, number_render_pass_, shaders::mesh_vert, shaders::number_frag);
    description.name = name;
    description.stencil_test = true;
    description.stencil_compare = VK_COMPARE_OP_EQUAL;
    return description;
}

VkPipeline Intersect::make(const gpu::GraphicsPipelineDescription& description) {
    return pipelines_.emplace_back(gpu::make_graphics_pipeline(*device_, description)).get();
}

StrategySteps& Intersect::add(IntersectionStrategy strategy, const char* pass_name) {
    StrategySteps& steps = steps_[static_cast<std::size_t>(strategy)];
    steps.pass_name = pass_name;
    steps.color_format = number_format;
    return steps;
}

/// B counts to 1; A counts from 1 to 2 and writes white.
void Intersect::make_stencil(const StencilPipelines& numbers) {
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
    steps.value_a = shaders::white;
    steps.count_b = 1;
}

/// 128 + 127 = 255. The edge's number is in the other three bytes: 0 + byte.
void Intersect::make_blend() {
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
void Intersect::make_logic_op(const StencilPipelines& numbers) {
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
void Intersect::make_depth(const StencilPipelines& numbers) {
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
    steps.value_a = shaders::white;
    steps.depth_b = 0.0F;
    steps.depth_a = 0.0F;
}

void Intersect::reset(VkCommandBuffer commands, const DrawContext& context) const {
    const auto count = static_cast<std::uint32_t>(context.batch.watched.size());
    if (count > 0) {
        device_->functions().vkCmdResetQueryPool(commands, queries_.get(), 0, count);
    }
}

graph::Handle Intersect::draw(const Canvas& canvas, IntersectionStrategy strategy) const {
    const StrategySteps& steps = this->steps(strategy);
    const std::string name = to_string(strategy);
    return add_drawing(canvas, steps.pass_name, {name + " hits", steps.color_format},
                       {name + " depth and stencil", device_->stencil_format()},
                       [this, strategy](VkCommandBuffer commands, const DrawContext& context) {
                           record(commands, context, strategy);
                       });
}

void Intersect::record(VkCommandBuffer commands, const DrawContext& context,
                       IntersectionStrategy strategy) const {
    using namespace stencil_bits;
    const StrategySteps& steps = this->steps(strategy);
    const TileRenderer renderer(*device_, layout_, commands, context);
    const auto range = [&](OverlapStep step) {
        return context.batch.meshes.range(overlaps_of(strategy, step));
    };

    renderer.bind(steps.clear);
    renderer.stencil(all, all, 0);
    renderer.draw(range(OverlapStep::clear), 1.0F, 0);

    // Where the stencil has counted to `count`: in volumes their fill has to be set as well.
    const auto fill = [&](OverlapStep step, std::uint32_t parity) {
        renderer.bind(steps.parity);
        renderer.stencil(all, parity, 0);
        renderer.draw(range(step), 1.0F, 0);
    };
    const auto take = [&](Part part, std::uint32_t parity, std::uint32_t count) {
        const std::uint32_t filled = part == Part::volume ? parity : 0;
        renderer.stencil(filled | counter, counter, filled | count);
    };
    fill(OverlapStep::parity_b, parity_b);
    renderer.bind(steps.b);
    take(Part::volume, parity_b, 0);
    renderer.draw(range(OverlapStep::volume_b), steps.depth_b, steps.value_b);
    take(Part::boundary, parity_b, 0);
    renderer.draw(range(OverlapStep::boundary_b), steps.depth_b, steps.value_b);

    fill(OverlapStep::parity_a, parity_a);
    renderer.bind(steps.a);
    take(Part::volume, parity_a, steps.count_b);
    renderer.draw(range(OverlapStep::volume_a), steps.depth_a, steps.value_a);
    take(Part::boundary, parity_a, steps.count_b);
    renderer.draw(range(OverlapStep::boundary_a), steps.depth_a, steps.value_a);

    const std::vector<WatchedTile>& watched = context.batch.watched;
    const std::uint32_t first = range(OverlapStep::watched_a).first;
    for (std::uint32_t query = 0; query < watched.size(); ++query) {
        if (watched[query].strategy == strategy) {
            take(watched[query].part_a, parity_a, steps.count_b);
            device_->functions().vkCmdBeginQuery(commands, queries_.get(), query, 0);
            renderer.draw({first + watched[query].a.first, watched[query].a.count}, steps.depth_a,
                          steps.value_a);
            device_->functions().vkCmdEndQuery(commands, queries_.get(), query);
        }
    }
}

void Intersect::copy_passed(DrawGraph& graph, graph::Handle& samples,
                            IntersectionStrategy strategy) const {
    graph.add_pass(
        "early out", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            samples = pass.write(samples, graph::Access::transfer_write);
        },
        [this, strategy, samples](const graph::PassCommands& commands, const DrawContext& context) {
            record_copies(commands, context, strategy,
                          commands.part(samples, passes::sample_parts::summaries));
        });
}

void Intersect::record_copies(VkCommandBuffer commands, const DrawContext& context,
                              IntersectionStrategy strategy,
                              const gpu::BufferPart& summaries) const {
    const std::vector<WatchedTile>& watched = context.batch.watched;
    for (std::uint32_t query = 0; query < watched.size(); ++query) {
        if (watched[query].strategy == strategy) {
            const VkDeviceSize offset = summaries.offset +
                                        watched[query].tile * sizeof(shaders::TileSummary) +
                                        offsetof(shaders::TileSummary, passed);
            device_->functions().vkCmdCopyQueryPoolResults(
                commands, queries_.get(), query, 1, summaries.buffer, offset, sizeof(std::uint32_t),
                VK_QUERY_RESULT_WAIT_BIT);
        }
    }
}

}  // namespace nearfield::raster
