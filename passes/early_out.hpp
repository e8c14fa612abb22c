#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// An occlusion query around A's last draw into a tile, the modern form of the paper's min/max and
/// histogram queries (section 2.2.1): where no sample passed, nothing is searched. The results stay
/// on the device. Which tiles are watched the plan says (plan::TileDraw::watch).
class EarlyOut {
public:
    EarlyOut(const gpu::Device& device, const Frame& frame);

    /// Makes the queries usable again; before each round, outside any render pass. All rounds share
    /// them: the reset waits on the device for what the round before, of this submission or of the
    /// one before it, does with them.
    void reset(VkCommandBuffer commands) const;

    /// Around the draws to watch; nothing where the tile is not watched.
    void begin(VkCommandBuffer commands, const plan::TileDraw& tile) const;
    void end(VkCommandBuffer commands, const plan::TileDraw& tile) const;

    /// Adds the pass that writes whether any sample passed into the summaries of a strategy's tiles
    /// (plan::TileSummary::passed); after the pass that draws them, which it follows by order of
    /// declaration: queries are no resources of the graph. Returns the new version of `samples`.
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, graph::Handle samples,
                                        IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, IntersectionStrategy strategy) const;

    const gpu::Device* device_;
    const Frame* frame_;
    gpu::Owned<VkQueryPool> pool_;
};

}  // namespace nearfield::passes
