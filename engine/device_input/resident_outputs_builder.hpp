#pragma once

#include <engine/device_input/compute_batch_builder.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/device_input/resident_outputs.hpp>
#include <engine/device_input/resident_samples_builder.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::device_input {

/// Determines which outputs of a batch stay on the device, where the tile batches write them, and
/// what the device needs to export them. Keeps its scratch memory.
class ResidentOutputsBuilder {
public:
    /// `results` state which queries were rejected. `room`: for so many records of a query, unless
    /// there cannot be as many, or they go to a buffer of the host's.
    void build(const Plan& plan, std::span<const ComputeBatch> tile_batches,
               std::span<const AnyResult> results, std::uint32_t room, ResidentOutputs& resident);

private:
    void find_field_parts(const Plan& plan, std::span<const ComputeBatch> tile_batches);
    void add_field(const PlannedQuery& planned, std::uint32_t query,
                   const DistanceFieldResult& result, ResidentOutputs& resident);
    void add_records(const Plan& plan, std::uint32_t query, std::uint32_t room,
                     ResidentOutputs& resident);

    ResidentSamplesBuilder samples_;
    std::vector<std::pair<std::uint32_t, FieldPartOutput>> parts_;  // with their query
    std::uint32_t searched_ = 0;                                    // passed so far
};

}  // namespace nearfield::device_input
