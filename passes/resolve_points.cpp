#include <passes/resolve_points.hpp>

#include <shaders/resolve_points_by_lists_comp.hpp>
#include <shaders/resolve_points_comp.hpp>

#include <functional>

namespace nearfield::passes {

ResolvePoints::ResolvePoints(const gpu::Device& device, const ComputeLayout& layout, Source source)
    : source_(source),
      shader_(source == Source::images
                  ? ComputeShader(device, layout, shaders::resolve_points_comp,
                                  "nearfield resolve points")
                  : ComputeShader(device, layout, shaders::resolve_points_by_lists_comp,
                                  "nearfield resolve points by lists")) {}

void ResolvePoints::declare(TileGraph& graph, graph::Handle input, graph::Handle results,
                            graph::Handle features, graph::Handle sign) const {
    static_cast<void>(graph.add_compute_pass(
        source_ == Source::images ? "resolve points" : "resolve points by lists",
        {{input, graph::Access::storage_read_in_compute},
         {features, graph::Access::sampled_in_compute},
         {sign, graph::Access::sampled_in_compute}},
        results, std::bind_front(&ResolvePoints::record, this)));
}

void ResolvePoints::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands,
                 source_ == Source::images ? context.sets.points : context.sets.points_by_lists);
    const auto count = static_cast<std::uint32_t>(context.batch.points.size());
    shader_.dispatch_elements<plan::ResolvePointsPush>(
        commands, 0, count, context.batch.resident ? count : plan::not_asked);
}

}  // namespace nearfield::passes
