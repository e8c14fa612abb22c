#include <passes/resolve_points.hpp>

#include <shaders/resolve_points_comp.hpp>

namespace nearfield::passes {

ResolvePoints::ResolvePoints(const gpu::Device& device, const graph::ComputeLayout& layout)
    : shader_(device, layout, shaders::resolve_points_comp, "nearfield resolve points") {}

void ResolvePoints::declare(TileGraph& graph, graph::Handle input, graph::Handle results,
                            graph::Handle features, graph::Handle sign) const {
    using graph::Access;
    add_pass(
        graph, "resolve points", shader_,
        {{0, input, read, input_parts::tiles},
         {1, input, read, input_parts::edges},
         {2, input, read, input_parts::points},
         {4, features, Access::sampled_in_compute},
         {5, sign, Access::sampled_in_compute},
         {3, results, write}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            const auto count = static_cast<std::uint32_t>(context.batch.points.size());
            shader.dispatch_elements<plan::ResolvePointsPush>(commands, 0, count);
        });
}

}  // namespace nearfield::passes
