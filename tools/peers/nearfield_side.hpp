#pragma once

#include <nearfield/context.hpp>
#include <nearfield/world.hpp>

#include <tools/common/scene_runner.hpp>
#include <tools/peers/problem.hpp>

#include <cstdint>
#include <span>
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

/// nearfield's intersection tests of shapes that stay where they are: a world and a list of pairs.
class KeptTests {
public:
    /// Both must outlive it. Throws if anything is rejected.
    KeptTests(const Problem& problem, Context& context);

    /// Runs one frame; returns milliseconds.
    double run_frame();

    /// By query: whether the shapes intersect.
    [[nodiscard]] std::span<const std::uint8_t> answers() const { return intersects_; }

private:
    World world_;
    std::vector<InstanceHandle> a_;
    std::vector<InstanceHandle> b_;
    std::vector<std::uint8_t> intersects_;
};

}  // namespace nearfield::peers
