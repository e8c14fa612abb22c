#include <passes/resolve_points.hpp>

#include <shaders/resolve_points_by_lists_comp.hpp>
#include <shaders/resolve_points_comp.hpp>

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
    using graph::Access;
    add_pass(
        graph, source_ == Source::images ? "resolve points" : "resolve points by lists", shader_,
        {{0, input, read, input_parts::tiles},
         {1, input, read, input_parts::edges},
         {2, input, read, input_parts::points},
         {4, features, Access::sampled_in_compute},
         {5, sign, Access::sampled_in_compute},
         {3, results, write}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            const auto count = static_cast<std::uint32_t>(context.batch.points.size());
            shader.dispatch_elements<plan::ResolvePointsPush>(
                commands, 0, count, context.batch.resident ? count : plan::not_asked);
        });
}

}  // namespace nearfield::passes
