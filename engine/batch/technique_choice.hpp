#pragma once

#include <engine/queries/query_shapes.hpp>
#include <engine/queries/technique.hpp>
#include <nearfield/context.hpp>
#include <nearfield/query.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace nearfield::batch {

/// What decides in a context which technique Technique::automatic is.
struct TechniqueRule {
    queries::AvailableTechniques available;
    std::uint64_t largest_range = 0;  ///< bytes of a storage buffer of the device
    /// Unset: the CPU answers whatever it can, since the device is software, or there is none.
    std::optional<DeviceThresholds> thresholds;
};

/// Replaces Technique::automatic as its comment says; `shapes`: of each query. It stays if no
/// available technique can answer, which the planner rejects. Other queries that will be rejected
/// get a technique too. Reads no vertex.
void choose_techniques(std::span<AnyQuery> queries, std::span<const queries::QueryShapes> shapes,
                       const TechniqueRule& rule);

}  // namespace nearfield::batch
