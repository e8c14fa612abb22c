#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/plan/plan.hpp>

#include <cstdint>
#include <span>

namespace nearfield {

/// Says of boundary points what the device would say, exactly and without it (Technique::cpu): the
/// same words, so that what follows is the same for both. Keeps its memory from batch to batch.
class ExactPoints {
public:
    /// Writes the words, by point of the plan, of a query, or a direction of it, that the CPU
    /// answers. Points that are too far to be contacts stay unresolved.
    void answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                exact::PlacedInstances& instances, std::span<std::uint32_t> words);

private:
    void answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                const exact::PlacedEdges& b, std::span<std::uint32_t> words);
    [[nodiscard]] bool contains(const exact::PlacedEdges& b, const geometry::Vector& point);
    [[nodiscard]] exact::NearestPoint nearest(const exact::PlacedEdges& b,
                                              const geometry::Vector& point,
                                              std::uint32_t first_guess);
    [[nodiscard]] bool is_unique(const exact::PlacedEdges& b, const geometry::Vector& point,
                                 const exact::NearestPoint& nearest, double margin);

    exact::Boundary boundary_;  // of B, where it has many edges
};

}  // namespace nearfield
