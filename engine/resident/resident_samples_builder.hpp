#pragma once

#include <engine/plan/compute_batch_builder.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::resident {

/// Determines which outputs of a batch's intersections stay on the device (see
/// ResidentOutputsBuilder). Keeps its scratch memory.
class ResidentSamplesBuilder {
public:
    /// Call first for each batch.
    void begin() { is_found_ = false; }
    /// Adds a query to the resident outputs. `tile_batches` are the same for all queries of a
    /// batch.
    void add(const plan::Plan& plan, std::span<const plan::ComputeBatch> tile_batches,
             std::uint32_t query, const IntersectionResult& result,
             plan::ResidentOutputs& resident);

private:
    struct FoundTile {
        std::uint32_t index = 0;  ///< in Plan::tiles
        std::uint32_t tile_batch = 0;
        plan::SampleTileData data;
    };

    void find_tiles(const plan::Plan& plan, std::span<const plan::ComputeBatch> tile_batches);
    void find_masks(const plan::Plan& plan, const plan::ComputeBatch& batch, std::uint32_t number);
    void add_tiles(const plan::Plan& plan, const IntersectionQuery& asked,
                   plan::ResidentOutputs& resident);
    void place_blocks(const plan::Plan& plan, std::span<FoundTile> tiles,
                      plan::SamplesOutput& samples) const;

    bool is_found_ = false;
    std::vector<FoundTile> tiles_;  // of all resident intersections
};

}  // namespace nearfield::resident
