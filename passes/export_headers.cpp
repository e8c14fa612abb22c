#include <engine/graph/access.hpp>
#include <passes/export_headers.hpp>

#include <shaders/export_headers_comp.hpp>

#include <functional>

namespace nearfield::passes {

// The graphs of records and samples leave their summaries readable by compute shaders, so the first
// barrier only has to keep this pass behind them.
ExportHeaders::ExportHeaders(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::export_headers_comp, "nearfield export headers"),
      headers_(graph_.import_buffer(
          {"resident headers"}, {graph::Access::exported_buffer, graph::Access::exported_buffer})) {
    graph_.add_pass(
        "export headers", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            static_cast<void>(pass.write(headers_, graph::Access::storage_write_in_compute));
        },
        std::bind_front(&ExportHeaders::dispatch, this));
    graph_.compile(device);
}

void ExportHeaders::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) const {
    graph::Executor& executor = graph_.executor();
    const graph::AccessTraits& exported = graph::traits(graph::Access::exported_buffer);
    executor.set_buffer(headers_, {.buffer = item.buffer,
                                   .uses = graph::ExternalUses{
                                       {exported.stages, exported.access()},
                                       {exported.stages | item.readers, exported.access()}}});
    graph_.execute(commands, timestamps, item);
}

void ExportHeaders::dispatch(VkCommandBuffer commands, const Item& item) const {
    shader_.bind(commands);
    for (std::size_t i = 0; i < item.headers.size(); ++i) {
        shader_.bind_set(commands, item.sets[i]);
        shader_.push(commands, item.headers[i]);
        shader_.dispatch(commands, 1);
    }
}

}  // namespace nearfield::passes
