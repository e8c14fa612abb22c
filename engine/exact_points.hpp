#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/plan/plan.hpp>

#include <cstdint>
#include <span>

namespace nearfield {

/// Says of boundary points what the device would say, exactly and without it (Technique::cpu): the
/// same words, so that what follows is the same for both. Keeps its memory from batch to batch.
class ExactPoints {
public:
    /// Writes the words, by point of the plan, of all queries that the CPU answers.
    void answer(const plan::Plan& plan, std::span<std::uint32_t> words);

private:
    void answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<std::uint32_t> words);

    exact::Boundary boundary_;
};

}  // namespace nearfield
