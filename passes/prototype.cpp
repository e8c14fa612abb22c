#include <engine/base/status_exception.hpp>
#include <engine/graph/execute.hpp>
#include <passes/prototype.hpp>

namespace nearfield::passes {

gpu::Owned<VkRenderPass> make_prototype(const gpu::Device& device, VkFormat color,
                                        VkFormat depth_stencil, const std::string& name) {
    graph::Graph graph;
    const graph::Handle colors = graph.create_image({"prototype colour", color, {1, 1}});
    graph.add_pass(name + " prototype", graph::PassKind::graphics, [&](graph::PassBuilder& pass) {
        static_cast<void>(pass.write(colors, graph::Access::color_attachment));
        if (depth_stencil != VK_FORMAT_UNDEFINED) {
            const graph::Handle depth =
                graph.create_image({"prototype depth", depth_stencil, {1, 1}});
            static_cast<void>(pass.write(depth, graph::Access::depth_stencil_attachment));
        }
    });
    const Expected<graph::BakedGraph> baked = graph::bake(graph);
    if (!baked) {
        throw StatusException(baked.error());
    }
    return graph::make_render_pass(device, graph, baked->passes.front());
}

}  // namespace nearfield::passes
