#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/plan/plan.hpp>
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
    void answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                const simd::TransformedEdges& b, std::span<std::uint32_t> words);
    [[nodiscard]] bool contains(const simd::TransformedEdges& b, const geometry::Vector& point);
    [[nodiscard]] narrowphase::NearestPoint nearest(const simd::TransformedEdges& b,
                                                    const geometry::Vector& point,
                                                    std::uint32_t first_guess);
    [[nodiscard]] bool is_unique(const simd::TransformedEdges& b, const geometry::Vector& point,
                                 const narrowphase::NearestPoint& nearest, double margin);

    narrowphase::Boundary boundary_;  // of B, if it has many edges
};

}  // namespace nearfield::cpu
