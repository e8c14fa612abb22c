#pragma once

#include <nearfield/context.hpp>

#include <tools/common/scene_runner.hpp>
#include <tools/peers/problem.hpp>

#include <string>
#include <vector>

namespace nearfield::peers {

/// nearfield on a problem: Technique::automatic, whole frames.
class NearfieldSide {
public:
    /// Both must outlive it.
    NearfieldSide(const Problem& problem, Context& context);

    /// Runs one frame; `input`: what is passed anew. Throws if anything is rejected.
    double run_frame(tools::FrameInput input);

    /// The answers of the last frame.
    [[nodiscard]] std::vector<Answer> answers() const;
    /// The results of the last frame, in the order of the queries.
    [[nodiscard]] std::vector<const AnyResult*> results() const;
    [[nodiscard]] std::string technique() const { return std::string(runner_.technique()); }

private:
    tools::SceneRunner runner_;
};

}  // namespace nearfield::peers
