#include <engine/gpu/pipeline.hpp>
#include <passes/color_fill.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fill.hpp>
#include <passes/resolve_field.hpp>

#include <shaders/resolve_field_comp.hpp>

#include <algorithm>

namespace nearfield::passes {

void FieldImages::declare_reads(graph::PassBuilder& pass) const {
    std::array<graph::Handle, 2 * plan::sign_encodings> seen;
    std::size_t count = 0;
    for (const Pair& pair : by_encoding) {
        for (const graph::Handle handle : {pair.features, pair.sign}) {
            if (handle != graph::Handle{} &&
                std::find(seen.begin(), seen.begin() + count, handle) == seen.begin() + count) {
                seen[count++] = handle;
                pass.read(handle, graph::Access::sampled_in_compute);
            }
        }
    }
}

std::uint32_t sign_mask(SignEncoding encoding) {
    switch (encoding) {
        case SignEncoding::color:
            return white_mask;
        case SignEncoding::feature_bit:
            return feature_bit_mask;
        case SignEncoding::stencil:
            break;
    }
    return filled_mask;
}

void bind_field_set(const gpu::Functions& functions, VkCommandBuffer commands,
                    VkPipelineLayout layout, const RecordContext& context, SignEncoding encoding) {
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1,
                                      &context.field[static_cast<std::size_t>(encoding)], 0,
                                      nullptr);
}

ResolveField::ResolveField(const gpu::Device& device, const ComputeLayout& layout,
                           const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_field_comp,
                                           "nearfield resolve field")) {}

graph::Handle ResolveField::declare(graph::Graph& graph, graph::Handle input,
                                    const FieldImages& images, graph::Handle field) const {
    graph.add_pass(
        "resolve field", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            images.declare_reads(pass);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return field;
}

void ResolveField::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
        const auto sign = static_cast<SignEncoding>(encoding);
        if (context_->round->groups[plan::group_list(sign)].empty()) {
            continue;
        }
        bind_field_set(functions, commands, layout_, *context_, sign);
        dispatch_groups(functions, commands, *context_->round, plan::group_list(sign),
                        [&](std::uint32_t first) {
                            const std::uint32_t push[3] = {first, sign_mask(sign),
                                                           context_->round->resident ? 1U : 0U};
                            functions.vkCmdPushConstants(commands, layout_,
                                                         VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                                         sizeof(push), push);
                        });
    }
}

}  // namespace nearfield::passes
