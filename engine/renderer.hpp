#pragma once

#include <engine/compute_buffers.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/plan/round.hpp>
#include <engine/recipe.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield {

/// Takes rounds to the device and back. Buffers, images and recipes only grow; the steady state
/// allocates nothing and creates nothing.
class Renderer {
public:
    explicit Renderer(const gpu::Device& device);

    /// Renders a round and waits for it; adds to the times of recording, device and passes. Where
    /// more samples are found than there was room for, the round runs again with room for all.
    void render(const plan::Round& round, plan::TileSize extent, Timings& timings);

    /// What the last round brought back: by point, of all fields, by tile (of overlap tiles only),
    /// and the samples of the tiles that list theirs, in any order. Valid until the next round.
    [[nodiscard]] std::span<const std::uint32_t> points() const;
    [[nodiscard]] std::span<const std::uint32_t> field_words() const;
    [[nodiscard]] std::span<const plan::TileSummary> summaries() const;
    [[nodiscard]] std::span<const plan::SampleData> samples() const;

    /// The graph of the last round; empty before the first.
    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    /// Where the parts of a buffer start, in bytes.
    struct InputParts {
        std::uint64_t tiles = 0, geometry = 0, points = 0, field_points = 0, end = 0;
    };
    struct OutputParts {
        std::uint64_t points = 0, field = 0, summaries = 0, samples = 0, end = 0;
    };

    Recipe& recipe_for(Needs needs, plan::TileSize extent);
    InputParts upload(const plan::Round& round);
    void lay_out_output(const plan::Round& round);
    void bind(const Recipe& recipe, const plan::Round& round, const InputParts& input);
    void bind_compute() const;
    void submit_and_wait(const Recipe& recipe, Timings& timings);
    [[nodiscard]] std::uint64_t align(std::uint64_t offset) const;
    void require_range(std::uint64_t bytes, const char* what) const;

    const gpu::Device* device_;
    passes::Frame frame_;
    passes::ComputeLayout layout_;
    Passes passes_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    gpu::MappedBuffer mesh_;
    gpu::MappedBuffer input_;
    gpu::MappedBuffer read_back_;
    ComputeBuffers compute_;
    std::vector<std::unique_ptr<Recipe>> recipes_;
    const Recipe* last_recipe_ = nullptr;
    OutputParts output_;
    std::uint32_t sample_count_ = 0;
    std::uint32_t most_samples_ = 0;  // that any round found, so that the next one has room
};

}  // namespace nearfield
