#pragma once

#include <engine/device_input/current_query.hpp>
#include <engine/device_input/tile_batch.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <nearfield/diagnostics.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield::render {

class TileWork;

/// Number of samples of intersections, and of points of searches, to reserve memory for: a likely
/// number, since what exceeds it can be submitted again; or all.
enum class SampleRoom { likely, all };

/// What all batches in flight share of a technique that works on tiles: its pipelines, its compiled
/// graphs with their images, and the memory in which tile batches are made. Batches and tile
/// batches use graphs one after the other (the graph's barriers order them, in one command buffer
/// and from one submission to the next on the same queue). Graphs only grow; the steady state
/// allocates nothing and creates nothing.
class TileTechnique {
public:
    TileTechnique() = default;
    virtual ~TileTechnique() = default;
    TileTechnique(const TileTechnique&) = delete;
    TileTechnique& operator=(const TileTechnique&) = delete;

    /// Plans a query about points as tiles, if the technique does so.
    virtual void plan_points(device_input::CurrentQuery& /*current*/, AnyResult& /*result*/) {}
    /// The part of a batch in flight. This has to outlive it.
    [[nodiscard]] virtual std::unique_ptr<TileWork> make_work() = 0;
    /// The time that making its own pipelines has taken.
    [[nodiscard]] virtual double pipeline_milliseconds() const { return 0.0; }
    /// Drops the compiled graphs, except those of batches in flight, until the next batch.
    virtual void trim() noexcept {
        last_graph_ = nullptr;
        max_samples_ = 0;
    }

    /// The graph of the last tile batch; empty if the last batch had none.
    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return last_graph_ == nullptr ? std::string() : last_graph_->print(format, title);
    }
    void set_last_graph(std::shared_ptr<const graph::CompiledGraph> graph) {
        last_graph_ = std::move(graph);
    }
    /// The number of samples to make room for in a tile batch that lists so many cells.
    [[nodiscard]] std::uint32_t sample_capacity(std::uint64_t listed_cells, SampleRoom room) const {
        const std::uint64_t expected =
            std::max<std::uint64_t>(max_samples_, 4096 + listed_cells / 8);
        return static_cast<std::uint32_t>(
            room == SampleRoom::all ? listed_cells : std::min(listed_cells, expected));
    }
    void note_samples(std::uint32_t found) { max_samples_ = std::max(max_samples_, found); }

private:
    std::shared_ptr<const graph::CompiledGraph> last_graph_;
    std::uint32_t max_samples_ = 0;  // largest number found by a tile batch, reserved for the next
};

/// The imported handles that tile batches of any technique write for the host; null where their
/// passes write none.
struct OutputHandles {
    graph::Handle results;  ///< of points
    graph::Handle field;    ///< results of fields
    graph::Handle samples;  ///< in the parts of passes::sample_parts
};

/// The graph of a tile batch, which keeps its images for as long as the device may use them.
struct UsedGraph {
    std::shared_ptr<const graph::CompiledGraph> graph;
    OutputHandles outputs;
};

/// The tile batches of one technique in a batch in flight: what its queries become, everything that
/// the host must not touch before the device is done with it, and what the device wrote. Each tile
/// batch has resources of its own, which its passes bind, and a part of the common read-back. Keeps
/// its memory; in the steady state nothing is created.
class TileWork {
public:
    /// `technique`: has to outlive this, as has the layout.
    TileWork(const gpu::Device& device, const graph::ComputeLayout& layout,
             TileTechnique& technique);
    virtual ~TileWork() = default;
    TileWork(const TileWork&) = delete;
    TileWork& operator=(const TileWork&) = delete;

    /// Makes the technique's tile batches of a plan, in place of those before.
    virtual void build(const device_input::Plan& plan) = 0;
    /// Number of tile batches.
    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] virtual const device_input::TileBatch& batch(std::uint32_t number) const = 0;

    /// Uploads the tile batches, which have to stay unchanged until the next call, and selects all
    /// of them for the next submission. No commands of this object may be in flight.
    void prepare(SampleRoom room);
    /// Selects those that found more samples than they had memory for, which they then have.
    void select_those_without_room();
    [[nodiscard]] std::span<const std::uint32_t> running() const { return running_; }
    /// Lays out the outputs of the selected tile batches and binds what their passes use.
    virtual void lay_out_output(graph::DescriptorUpdates& updates);
    /// Of the selected tile batches.
    [[nodiscard]] virtual std::size_t pass_count() const;
    virtual void record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const;
    /// Call once the device is done.
    void read_back();
    /// Releases the compiled graphs; not while in flight.
    void release();

    [[nodiscard]] bool had_room(std::uint32_t number) const { return states_[number].had_room(); }
    /// Whether the device left fields of the tile batch unanswered.
    [[nodiscard]] virtual bool left_fields(std::uint32_t /*number*/) const { return false; }
    /// The results of a tile batch: by point; of all fields; by tile (overlap tiles only); and the
    /// samples of the tiles that list theirs, in any order. Valid after read_back(), until the next
    /// upload.
    [[nodiscard]] std::span<const std::uint32_t> points(std::uint32_t number) const;
    [[nodiscard]] std::span<const std::uint32_t> field_words(std::uint32_t number) const;
    [[nodiscard]] std::span<const shaders::TileSummary> summaries(std::uint32_t number) const;
    [[nodiscard]] std::span<const shaders::SampleData> samples(std::uint32_t number) const;

protected:
    /// Byte offsets of a tile batch's parts in the read-back.
    struct OutputParts {
        std::uint64_t points = 0, field = 0, summaries = 0, samples = 0, end = 0;
    };

    void set_count(std::uint32_t count) { count_ = count; }
    /// Uploads the input of all tile batches.
    virtual void upload() = 0;
    [[nodiscard]] virtual UsedGraph graph_for(std::uint32_t number) = 0;
    /// Sets what passes of a tile batch bind beside their outputs.
    virtual void bind_input(std::uint32_t number, graph::BoundResources& resources) = 0;
    /// Records a tile batch with its resources and room for so many samples.
    virtual void record_tiles(std::uint32_t number, const graph::BoundResources& resources,
                              std::uint32_t sample_capacity, VkCommandBuffer commands,
                              gpu::Timestamps& timestamps) const = 0;
    /// The buffer into which a tile batch writes the words of its fields, laid out as the read-back
    /// is.
    [[nodiscard]] virtual const gpu::MappedBuffer& words_of(std::uint32_t /*number*/) const {
        return read_back_;
    }

    [[nodiscard]] const gpu::Device& device() const { return *device_; }
    [[nodiscard]] const graph::ComputeLayout& layout() const { return *layout_; }
    [[nodiscard]] const gpu::MappedBuffer& read_back_buffer() const { return read_back_; }
    [[nodiscard]] const OutputParts& output(std::uint32_t number) const {
        return states_[number].output;
    }
    template <class Graph>
    [[nodiscard]] const Graph& graph_of(std::uint32_t number) const {
        return static_cast<const Graph&>(*states_[number].of.graph);
    }
    /// Where the next part of a buffer may begin.
    [[nodiscard]] std::uint64_t align(std::uint64_t offset) const;

private:
    /// The device's side of a tile batch.
    struct State {
        UsedGraph of;
        OutputParts output;
        std::uint32_t sample_capacity = 0;
        std::uint32_t sample_count = 0;  // found; only sample_capacity of them were stored

        [[nodiscard]] bool had_room() const { return sample_count <= sample_capacity; }
    };
    /// The resources of a tile batch, one for each graph that it was last executed with and that
    /// there still is, so that kinds of batches can alternate.
    struct Bound {
        struct WithGraph {
            std::weak_ptr<const graph::CompiledGraph> graph;
            std::unique_ptr<graph::BoundResources> resources;
        };
        std::vector<WithGraph> all;
        graph::BoundResources* current = nullptr;

        [[nodiscard]] graph::BoundResources& use(
            const std::shared_ptr<const graph::CompiledGraph>& graph,
            const graph::ComputeLayout& layout);
    };

    void empty_output(std::uint32_t number) const;
    void bind(std::uint32_t number, graph::DescriptorUpdates& updates);

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    TileTechnique* technique_;
    std::uint32_t count_ = 0;
    gpu::MappedBuffer read_back_;
    std::vector<State> states_;           // by tile batch
    std::vector<Bound> bound_;            // by tile batch, and more of it that an earlier batch had
    std::vector<std::uint32_t> running_;  // selected tile batches
};

}  // namespace nearfield::render
