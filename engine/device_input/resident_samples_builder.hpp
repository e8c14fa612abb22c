#pragma once

#include <engine/device_input/compute_batch_builder.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/device_input/resident_outputs.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::device_input {

/// Determines which outputs of a batch's intersections stay on the device (see
/// ResidentOutputsBuilder). Keeps its scratch memory.
class ResidentSamplesBuilder {
public:
    /// Call first for each batch.
    void begin() { is_found_ = false; }
    /// Adds a query to the resident outputs. `tile_batches` are the same for all queries of a
    /// batch.
    void add(const Plan& plan, std::span<const ComputeBatch> tile_batches, std::uint32_t query,
             const IntersectionResult& result, ResidentOutputs& resident);

private:
    struct FoundTile {
        std::uint32_t index = 0;  ///< in Plan::tiles
        std::uint32_t tile_batch = 0;
        shaders::SampleTileData data;
    };

    void find_tiles(const Plan& plan, std::span<const ComputeBatch> tile_batches);
    void find_masks(const Plan& plan, const ComputeBatch& batch, std::uint32_t number);
    void add_tiles(const Plan& plan, const IntersectionQuery& asked, ResidentOutputs& resident);
    void place_blocks(const Plan& plan, std::span<FoundTile> tiles, SamplesOutput& samples) const;

    bool is_found_ = false;
    std::vector<FoundTile> tiles_;  // of all resident intersections
};

}  // namespace nearfield::device_input
