#pragma once

#include <nearfield/context.hpp>

#include <tools/common/scene_runner.hpp>
#include <tools/peers/problem.hpp>

#include <string>
#include <vector>

namespace nearfield::peers {

/// nearfield on a problem: Technique::automatic, whole frames, everything submitted anew each
/// frame.
class NearfieldSide {
public:
    /// Both must outlive it.
    NearfieldSide(const Problem& problem, Context& context);

    /// Runs one frame. Throws if anything is rejected.
    double run_frame();

    /// The answers of the last frame.
    [[nodiscard]] std::vector<Answer> answers() const;
    /// The results of the last frame, in the order of the queries.
    [[nodiscard]] std::vector<const AnyResult*> results() const;
    [[nodiscard]] std::string technique() const { return std::string(runner_.technique()); }

private:
    tools::SceneRunner runner_;
};

}  // namespace nearfield::peers
