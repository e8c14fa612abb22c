#pragma once

#include <engine/device_input/compute_batch_builder.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/render/compute_buffers.hpp>
#include <engine/render/pipeline_set.hpp>
#include <engine/render/resident_buffers.hpp>
#include <engine/render/tile_work.hpp>
#include <passes/fields.hpp>
#include <passes/record_context.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::render {

class ComputedTiles;

/// The outputs that a tile batch of the compute technique needs, which determine its graph.
struct ComputeKey {
    bool field_values = false;
    bool field_features = false;
    bool field_points = false;  ///< some output at points of a field
    bool overlap = false;
    bool keeps_hits = false;  ///< another pass reads the masks of some overlap

    explicit ComputeKey(const device_input::ComputeBatch& batch);
    [[nodiscard]] bool fields() const { return field_values || field_features; }

    friend bool operator==(const ComputeKey&, const ComputeKey&) = default;
};

/// The graph for one ComputeKey.
class ComputeGraph final : public passes::TileGraph {
public:
    ComputeGraph(const gpu::Device& device, const PipelineSet& passes, const ComputeKey& needs);

    [[nodiscard]] const ComputeKey& needs() const { return needs_; }
    [[nodiscard]] const ComputeHandles& handles() const { return handles_; }
    [[nodiscard]] const OutputHandles& outputs() const { return outputs_; }

private:
    /// The passes over masks, and of fields at cells, which write `output`.
    void declare_masked(const PipelineSet& passes, passes::Fields::Output& output);

    ComputeKey needs_;
    ComputeHandles handles_;
    OutputHandles outputs_;
};

/// Tiles of technique compute: fields and intersections.
class ComputeTechnique final : public TileTechnique {
public:
    ComputeTechnique(const gpu::Device& device, const graph::ComputeLayout& layout,
                     const PipelineSet& passes)
        : device_(&device), layout_(&layout), passes_(&passes) {}

    [[nodiscard]] std::unique_ptr<TileWork> make_work() override;
    [[nodiscard]] std::unique_ptr<ComputedTiles> make_computed();
    void trim() noexcept override {
        TileTechnique::trim();
        graphs_.clear();
    }

    [[nodiscard]] std::shared_ptr<const ComputeGraph> graph_for(
        const device_input::ComputeBatch& batch);
    [[nodiscard]] const PipelineSet& passes() const { return *passes_; }
    [[nodiscard]] device_input::ComputeBatchBuilder& builder() { return builder_; }

private:
    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    const PipelineSet* passes_;
    std::vector<std::shared_ptr<const ComputeGraph>> graphs_;
    device_input::ComputeBatchBuilder builder_;
};

/// The tile batches of technique compute in a batch in flight.
class ComputedTiles final : public TileWork {
public:
    ComputedTiles(const gpu::Device& device, const graph::ComputeLayout& layout,
                  ComputeTechnique& technique);

    void build(const device_input::Plan& plan) override;
    [[nodiscard]] const device_input::TileBatch& batch(std::uint32_t number) const override {
        return batches_[number];
    }
    [[nodiscard]] std::span<const device_input::ComputeBatch> batches() const {
        return std::span(batches_).first(count());
    }
    void lay_out_output(graph::DescriptorUpdates& updates) override;
    [[nodiscard]] std::size_t pass_count() const override;
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const override;
    [[nodiscard]] bool left_fields(std::uint32_t number) const override {
        return buffers_[number]->had_long_searches();
    }

    /// Where all tile batches write what stays on the device. `none`: any part of the buffer that
    /// holds their words.
    [[nodiscard]] std::span<const ResidentBuffers::Words> words(gpu::BufferPart& none);

protected:
    void upload() override;
    [[nodiscard]] UsedGraph graph_for(std::uint32_t number) override {
        auto graph = technique_->graph_for(batches_[number]);
        return {graph, graph->outputs()};
    }
    void bind_input(std::uint32_t number, graph::BoundResources& resources) override;
    void record_tiles(std::uint32_t number, const graph::BoundResources& resources,
                      std::uint32_t sample_capacity, VkCommandBuffer commands,
                      gpu::Timestamps& timestamps) const override;
    [[nodiscard]] const gpu::MappedBuffer& words_of(std::uint32_t number) const override {
        return batches_[number].resident ? words_ : read_back_buffer();
    }

private:
    void find_copies(std::uint32_t number);
    void bind_copies();

    ComputeTechnique* technique_;
    std::vector<device_input::ComputeBatch> batches_;  // the first count() of them
    /// By tile batch. Each has scratch memory of its own, since no barrier separates the tile
    /// batches of a submission.
    std::vector<std::unique_ptr<ComputeBuffers>> buffers_;
    /// Laid out like the read-back, for tile batches whose results stay on the device.
    gpu::MappedBuffer words_;
    std::vector<VkBufferCopy> copies_;  // of these words, which the host reads as well
    std::optional<graph::BoundResources> bound_copies_;
    std::vector<ResidentBuffers::Words> resident_words_;  // by tile batch
};

}  // namespace nearfield::render
