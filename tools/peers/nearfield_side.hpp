#pragma once

#include <nearfield/context.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/common/scene_runner.hpp>
#include <tools/peers/problem.hpp>

#include <cstdint>
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

/// nearfield on a list of pairs of shapes that stay where they are: a world.
class KeptPairs {
public:
    /// Both must outlive it. Throws if anything is rejected.
    KeptPairs(const Problem& problem, Context& context);

    /// Whether a world answers lists of pairs for such a task.
    [[nodiscard]] static bool answers(Task task) {
        return task == Task::intersection_test || task == Task::vertex_penetration;
    }

    /// Runs one frame; returns milliseconds.
    double run_frame();

    /// Throws unless the answers of the last frame are these results.
    void require_same(const std::vector<const AnyResult*>& results);

private:
    const Problem& problem_;
    World world_;
    std::vector<InstanceHandle> a_;
    std::vector<InstanceHandle> b_;
    PairTable<IntersectionTestQuery> tests_;
    PairTable<PenetrationQuery> penetrations_;
};

}  // namespace nearfield::peers
