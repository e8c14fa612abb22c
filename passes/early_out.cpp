#include <passes/early_out.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::passes {

EarlyOut::EarlyOut(const gpu::Device& device) : device_(&device) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = plan::max_watched;
    pool_ = gpu::make_object(device, info, "the occlusion queries of intersections",
                             "nearfield occlusion queries");
}

void EarlyOut::reset(VkCommandBuffer commands, const RecordContext& context) const {
    const auto count = static_cast<std::uint32_t>(context.batch.raster.watched.size());
    if (count > 0) {
        device_->functions().vkCmdResetQueryPool(commands, pool_.get(), 0, count);
    }
}

void EarlyOut::begin(VkCommandBuffer commands, std::uint32_t query) const {
    device_->functions().vkCmdBeginQuery(commands, pool_.get(), query, 0);
}

void EarlyOut::end(VkCommandBuffer commands, std::uint32_t query) const {
    device_->functions().vkCmdEndQuery(commands, pool_.get(), query);
}

void EarlyOut::declare(TileGraph& graph, graph::Handle& samples,
                       IntersectionStrategy strategy) const {
    graph.add_pass(
        "early out", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            samples = pass.write(samples, graph::Access::transfer_write);
        },
        [this, strategy, samples](const graph::PassCommands& commands,
                                  const RecordContext& context) {
            record(commands, context, strategy, commands.part(samples, sample_parts::summaries));
        });
}

void EarlyOut::record(VkCommandBuffer commands, const RecordContext& context,
                      IntersectionStrategy strategy, const gpu::BufferPart& summaries) const {
    const std::vector<plan::WatchedTile>& watched = context.batch.raster.watched;
    for (std::uint32_t query = 0; query < watched.size(); ++query) {
        if (watched[query].strategy == strategy) {
            const VkDeviceSize offset = summaries.offset +
                                        watched[query].tile * sizeof(plan::TileSummary) +
                                        offsetof(plan::TileSummary, passed);
            device_->functions().vkCmdCopyQueryPoolResults(
                commands, pool_.get(), query, 1, summaries.buffer, offset, sizeof(std::uint32_t),
                VK_QUERY_RESULT_WAIT_BIT);
        }
    }
}

}  // namespace nearfield::passes
