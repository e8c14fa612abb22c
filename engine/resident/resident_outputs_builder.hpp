#pragma once

#include <engine/plan/compute_batch_builder.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <engine/resident/resident_samples_builder.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::resident {

/// Determines which outputs of a batch stay on the device, where the tile batches write them, and
/// what the device needs to export them. Keeps its scratch memory.
class ResidentOutputsBuilder {
public:
    /// `results` state which queries were rejected. `room`: for so many records of a query, unless
    /// there cannot be as many, or they go to a buffer of the host's.
    void build(const plan::Plan& plan, std::span<const plan::ComputeBatch> tile_batches,
               std::span<const AnyResult> results, std::uint32_t room,
               plan::ResidentOutputs& resident);

private:
    void find_field_parts(const plan::Plan& plan, std::span<const plan::ComputeBatch> tile_batches);
    void add_field(const plan::PlannedQuery& planned, std::uint32_t query,
                   const DistanceFieldResult& result, plan::ResidentOutputs& resident);
    void add_records(const plan::Plan& plan, std::uint32_t query, std::uint32_t room,
                     plan::ResidentOutputs& resident);

    ResidentSamplesBuilder samples_;
    std::vector<std::pair<std::uint32_t, plan::FieldPartOutput>> parts_;  // with their query
    std::uint32_t searched_ = 0;                                          // passed so far
};

}  // namespace nearfield::resident
