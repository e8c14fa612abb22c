#pragma once

#include <nearfield/world.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/peers/problem.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::peers {

/// A peer's times for a problem.
struct PeerTimes {
    std::string name;
    std::string how;
    benchmark::Spread built_ms;  ///< transforms the shapes, builds geometries and indices, answers
    benchmark::Spread kept_ms;   ///< answers only: everything built is kept, as if nothing had
                                 ///< moved
    double largest_difference = 0.0;  ///< to nearfield's answers
    double allowed = 0.0;             ///< the allowance for that difference
    std::size_t apart = 0;            ///< answers that differ by more than its rounding
};

struct ProblemTimes {
    std::string name;
    std::string_view task;
    std::size_t queries = 0;
    std::string technique;       ///< the technique nearfield used
    benchmark::Spread built_ms;  ///< of nearfield: all shapes passed anew; not measured of worlds
    benchmark::Spread kept_ms;   ///< of nearfield: shapes and poses as in the frame before
    std::vector<PeerTimes> peers;

    /// The median of the fastest peer; empty if there is none.
    [[nodiscard]] std::optional<double> quickest(benchmark::Spread PeerTimes::*times) const;
};

/// Compares the answers of nearfield with those of all peers that support the task, then measures
/// them in turns. Throws std::runtime_error if answers disagree, because then the times mean
/// nothing.
[[nodiscard]] ProblemTimes race(const Problem& problem, Context& context);

}  // namespace nearfield::peers
