#pragma once

#include <engine/plan/planner.hpp>
#include <engine/plan/round.hpp>
#include <engine/renderer.hpp>
#include <engine/results.hpp>
#include <nearfield/result.hpp>

#include <span>

namespace nearfield {

/// One batch from queries to results: plans it, renders its rounds, decodes what comes back. Keeps
/// its memory from batch to batch.
class BatchRunner {
public:
    /// The renderer must outlive the runner.
    BatchRunner(const plan::PlanLimits& limits, const char* gradient_format, Renderer& renderer);

    /// Writes the results and adds to the times, but for their total. Normals of contacts that are
    /// to be gradients are left to GradientNormals.
    void run(std::span<const AnyQuery> queries, const plan::FindShape& find_shape,
             Results& results);

    /// Of the last batch, until the next.
    [[nodiscard]] const plan::Plan& plan() const { return plan_; }
    [[nodiscard]] std::span<const std::uint32_t> point_words() const {
        return decoder_.point_words();
    }

private:
    Renderer* renderer_;
    plan::Planner planner_;
    plan::RoundBuilder builder_;
    plan::Plan plan_;
    plan::Round round_;
    ResultDecoder decoder_;
};

}  // namespace nearfield
