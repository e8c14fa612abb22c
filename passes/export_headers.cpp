#include <engine/gpu/pipeline.hpp>
#include <engine/graph/access.hpp>
#include <engine/graph/print.hpp>
#include <passes/export_headers.hpp>

#include <shaders/export_headers_comp.hpp>

namespace nearfield::passes {

static_assert(sizeof(ExportHeaders::Header) <= ComputeLayout::push_bytes);

// The graphs of records and samples leave their summaries readable by compute shaders, so the first
// barrier only has to keep this pass behind them.
ExportHeaders::ExportHeaders(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::export_headers_comp,
                                           "nearfield export headers")),
      headers_(graph_.import_buffer(
          {"resident headers"}, {graph::Access::exported_buffer, graph::Access::exported_buffer})) {
    graph_.add_pass(
        "export headers", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            static_cast<void>(pass.write(headers_, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { dispatch(commands); });
    executor_ = graph::make_executor(device, graph_);
}

void ExportHeaders::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) {
    item_ = item;
    const graph::AccessTraits& exported = graph::traits(graph::Access::exported_buffer);
    executor_->set_buffer(headers_, {.buffer = item.buffer,
                                     .uses = graph::ExternalUses{
                                         {exported.stages, exported.access()},
                                         {exported.stages | item.readers, exported.access()}}});
    executor_->execute(graph_, commands, timestamps);
}

void ExportHeaders::dispatch(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    for (std::size_t i = 0; i < item_.headers.size(); ++i) {
        functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                          &item_.sets[i], 0, nullptr);
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(Header), &item_.headers[i]);
        functions.vkCmdDispatch(commands, 1, 1, 1);
    }
}

std::string ExportHeaders::print(GraphFormat format) const {
    return graph::print(graph_, executor_->baked(), format);
}

}  // namespace nearfield::passes
