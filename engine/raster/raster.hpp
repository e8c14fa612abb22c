#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/raster/drawn_batch_builder.hpp>
#include <engine/raster/drawn_graph.hpp>
#include <engine/raster/point_planner.hpp>
#include <engine/render/tile_work.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace nearfield::raster {

/// The technique of the paper: tiles drawn into an atlas of images.
class Raster final : public render::TileTechnique {
public:
    /// The layout has to outlive this. `makes_pipelines`: at once, and none later; otherwise all
    /// when a batch first needs one.
    Raster(const gpu::Device& device, const graph::ComputeLayout& layout, bool makes_pipelines);

    void plan_points(device_input::CurrentQuery& current, AnyResult& result) override {
        points_.plan(current, result);
    }
    [[nodiscard]] std::unique_ptr<render::TileWork> make_work() override;
    [[nodiscard]] double pipeline_milliseconds() const override { return milliseconds_; }
    void trim() noexcept override {
        TileTechnique::trim();
        graphs_.clear();
    }

    /// The graph for a tile batch, with an atlas of at least this size.
    [[nodiscard]] std::shared_ptr<const DrawnGraph> graph_for(const DrawnBatch& batch,
                                                              TileSize atlas);
    [[nodiscard]] const Pipelines& pipelines();
    [[nodiscard]] DrawnBatchBuilder& builder() { return builder_; }

private:
    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    std::optional<Pipelines> pipelines_;
    double milliseconds_ = 0.0;  // that making them has taken
    // Each keeps its images: at most as many as kinds of batches alternate in practice.
    std::vector<std::shared_ptr<const DrawnGraph>> graphs_;
    PointPlanner points_;
    DrawnBatchBuilder builder_;
};

}  // namespace nearfield::raster
