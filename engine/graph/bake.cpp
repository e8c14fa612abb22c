#include <engine/graph/access.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/bake_steps.hpp>

#include <algorithm>

namespace nearfield::graph {

namespace {

/// Finds the attachments of a pass: colours in the order of declaration, then depth-stencil.
void find_attachments(const Graph& graph, const BakedGraph& baked, std::uint32_t position,
                      BakedPass& pass) {
    for (const Use& use : graph.passes()[pass.pass].uses) {
        const std::uint32_t resource = use.handle.resource;
        if (!traits(use.access).of_image) {
            continue;
        }
        pass.attachments.push_back({.resource = resource,
                                    .access = use.access,
                                    .load = use.handle.version > 0,
                                    .store = baked.lifetimes[resource].last > position});
        pass.extent = graph.resources()[resource].image.extent;
    }
    std::stable_partition(
        pass.attachments.begin(), pass.attachments.end(),
        [](const Attachment& attachment) { return attachment.access == Access::color_attachment; });
}

}  // namespace

Expected<BakedGraph> bake(const Graph& graph, VkQueueFlags queue) {
    if (Status status = check_declarations(graph, queue); !status.ok()) {
        return status;
    }
    const Expected<std::vector<std::uint32_t>> order = order_passes(graph);
    if (!order) {
        return order.error();
    }
    BakedGraph baked;
    for (const std::uint32_t pass : *order) {
        baked.passes.emplace_back().pass = pass;
    }
    find_lifetimes(graph, baked);
    place_barriers(graph, queue, baked);
    for (std::uint32_t position = 0; position < baked.passes.size(); ++position) {
        BakedPass& pass = baked.passes[position];
        if (graph.passes()[pass.pass].kind == PassKind::graphics) {
            find_attachments(graph, baked, position, pass);
        }
    }
    return baked;
}

}  // namespace nearfield::graph
