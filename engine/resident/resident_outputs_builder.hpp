#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/resident/resident_samples_builder.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::resident {

/// Determines which outputs of a batch stay on the device, where the tile batches write them, and
/// what the device needs to export them. Keeps its scratch memory.
class ResidentOutputsBuilder {
public:
    /// `results` state which queries were rejected.
    void build(const plan::Plan& plan, std::span<const plan::TileBatch> tile_batches,
               std::span<const AnyResult> results, plan::ResidentOutputs& resident);

private:
    void find_field_parts(const plan::Plan& plan, std::span<const plan::TileBatch> tile_batches);
    void add_field(const plan::PlannedQuery& planned, std::uint32_t query,
                   const DistanceFieldResult& result, plan::ResidentOutputs& resident);
    void add_records(const plan::Plan& plan, std::span<const plan::TileBatch> tile_batches,
                     std::uint32_t query, plan::ResidentOutputs& resident);
    void add_runs(const plan::Plan& plan, std::span<const plan::TileBatch> tile_batches,
                  const plan::PlannedQuery& planned, std::uint32_t flags,
                  plan::ResidentOutputs& resident);
    [[nodiscard]] std::uint32_t normal_at(const plan::PlannedQuery& planned,
                                          const plan::BoundaryPoint& point);

    ResidentSamplesBuilder samples_;
    std::vector<std::pair<std::uint32_t, plan::FieldPartOutput>> parts_;  // with their query
    std::optional<geometry::TransformedPolygon> b_;                       // for contacts
    narrowphase::Boundary boundary_;                                      // of B, where it is set
};

}  // namespace nearfield::resident
