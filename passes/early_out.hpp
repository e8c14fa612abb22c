#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

#include <cstdint>

namespace nearfield::passes {

/// An occlusion query around A's last draw into a tile, in place of the paper's min/max and
/// histogram queries (section 2.2.1). If no sample passed, the tile is not searched. The results
/// stay on the device. The plan selects the tiles (plan::TileBatch::watched), which are drawn by
/// themselves. Samples that pass beside the tile count as well, which only costs the search.
class EarlyOut {
public:
    explicit EarlyOut(const gpu::Device& device);

    /// Resets the queries; call before each tile batch, outside a render pass. All tile batches
    /// share the queries, so on the device the reset waits for the previous tile batch, also that
    /// of the previous submission.
    void reset(VkCommandBuffer commands, const RecordContext& context) const;

    /// Begins and ends a query, by position in plan::TileBatch::watched.
    void begin(VkCommandBuffer commands, std::uint32_t query) const;
    void end(VkCommandBuffer commands, std::uint32_t query) const;

    /// Adds the pass that writes whether any sample passed to the summaries of a strategy's tiles
    /// (plan::TileSummary::passed). Declare it after the pass that draws them: queries are not
    /// resources of the graph, so only the order of declaration orders the two.
    void declare(TileGraph& graph, graph::Handle& samples, IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context,
                IntersectionStrategy strategy, const gpu::BufferPart& summaries) const;

    const gpu::Device* device_;
    gpu::Owned<VkQueryPool> pool_;
};

}  // namespace nearfield::passes
