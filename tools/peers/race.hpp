#pragma once

#include <nearfield/context.hpp>

#include <tools/benchmark/spread.hpp>
#include <tools/peers/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::peers {

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
