#include <passes/early_out.hpp>

#include <cstddef>

namespace nearfield::passes {

EarlyOut::EarlyOut(const gpu::Device& device, const RecordContext& context)
    : device_(&device), context_(&context) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = plan::max_watched;
    VkQueryPool pool = VK_NULL_HANDLE;
    gpu::check(
        device.functions().vkCreateQueryPool(device.handle(), &info, device.allocator(), &pool),
        "vkCreateQueryPool", "the occlusion queries of intersections");
    pool_ = gpu::Owned<VkQueryPool>(device, pool);
    device.name_object(VK_OBJECT_TYPE_QUERY_POOL, pool, "nearfield occlusion queries");
}

void EarlyOut::reset(VkCommandBuffer commands) const {
    if (context_->round->watched > 0) {
        device_->functions().vkCmdResetQueryPool(commands, pool_.get(), 0,
                                                 context_->round->watched);
    }
}

void EarlyOut::begin(VkCommandBuffer commands, const plan::TileDraw& tile) const {
    if (tile.watch != plan::no_watch) {
        device_->functions().vkCmdBeginQuery(commands, pool_.get(), tile.watch, 0);
    }
}

void EarlyOut::end(VkCommandBuffer commands, const plan::TileDraw& tile) const {
    if (tile.watch != plan::no_watch) {
        device_->functions().vkCmdEndQuery(commands, pool_.get(), tile.watch);
    }
}

graph::Handle EarlyOut::declare(graph::Graph& graph, graph::Handle samples,
                                IntersectionStrategy strategy) const {
    graph.add_pass(
        "early out", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            samples = pass.write(samples, graph::Access::transfer_write);
        },
        [this, strategy](VkCommandBuffer commands) { record(commands, strategy); });
    return samples;
}

void EarlyOut::record(VkCommandBuffer commands, IntersectionStrategy strategy) const {
    const auto& tiles = context_->round->overlap_draws[static_cast<std::size_t>(strategy)];
    for (const plan::TileDraw& tile : tiles) {
        if (tile.watch != plan::no_watch) {
            const VkDeviceSize offset = context_->summaries_offset +
                                        tile.tile * sizeof(plan::TileSummary) +
                                        offsetof(plan::TileSummary, passed);
            device_->functions().vkCmdCopyQueryPoolResults(
                commands, pool_.get(), tile.watch, 1, context_->read_back, offset,
                sizeof(std::uint32_t), VK_QUERY_RESULT_WAIT_BIT);
        }
    }
}

}  // namespace nearfield::passes
