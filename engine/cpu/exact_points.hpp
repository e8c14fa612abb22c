#pragma once

#include <engine/narrowphase/located_points.hpp>
#include <engine/plan/plan.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <span>

namespace nearfield::cpu {

/// Computes exactly, without the device (Technique::cpu), the words that the device would write for
/// boundary points, so both share the same decoding. Reuses its memory between batches.
class ExactPoints {
public:
    /// Writes the words, by point of the plan, of a query (or one direction of it) that the CPU
    /// answers. Points too far away to be contacts stay unresolved.
    void answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                simd::TransformedInstances& instances, std::span<std::uint32_t> words);

private:
    void answer(const plan::PlannedQuery& query, double rounding_of_a,
                const simd::TransformedEdges& b, std::span<std::uint32_t> words);

    simd::PointList points_;  // of a part of the query
    narrowphase::LocatedPoints located_;
};

}  // namespace nearfield::cpu
