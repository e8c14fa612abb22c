#pragma once

#include <nearfield/context.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/peers/problem.hpp>

#include <cstdint>
#include <optional>
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

/// A peer's times for a problem.
struct PeerTimes {
    std::string name;
    std::string how;
    bool exact = true;
    bool has_sign = true;        ///< for a field
    benchmark::Spread built_ms;  ///< transforms the shapes, builds geometries and indices, answers
    benchmark::Spread kept_ms;   ///< answers only: everything built is kept, as if nothing had
                                 ///< moved
    double largest_difference = 0.0;  ///< to nearfield's answers
    double allowed = 0.0;             ///< the allowance for that difference
    double error_in_cells = 0.0;      ///< for a field, if the peer is not exact
};

struct ProblemTimes {
    std::string name;
    std::size_t queries = 0;
    std::string technique;       ///< the technique nearfield used
    benchmark::Spread built_ms;  ///< of nearfield: all shapes passed anew
    benchmark::Spread kept_ms;   ///< of nearfield: shapes and poses as in the frame before
    std::vector<PeerTimes> peers;

    /// The median of the fastest peer that gives the whole answer exactly; empty if there is none.
    [[nodiscard]] std::optional<double> quickest(benchmark::Spread PeerTimes::*times) const;
};

/// Compares the answers of nearfield with those of all peers that support the task, then measures
/// them in turns. Throws std::runtime_error if answers disagree, because then the times mean
/// nothing.
[[nodiscard]] ProblemTimes race(const Problem& problem, Context& context);

}  // namespace nearfield::peers
