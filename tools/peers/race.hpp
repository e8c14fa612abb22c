#pragma once

#include <nearfield/context.hpp>

#include <tools/benchmark/spread.hpp>
#include <tools/peers/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::peers {

/// What a peer took for a problem.
struct PeerTimes {
    std::string name;
    std::string how;
    bool exact = true;
    bool has_sign = true;        ///< of a field
    benchmark::Spread built_ms;  ///< places the shapes, makes its geometries and indices, answers
    benchmark::Spread kept_ms;   ///< answers: all it made stays, as if nothing had moved
    double largest_difference = 0.0;  ///< from nearfield's answers
    double allowed = 0.0;             ///< there
    double error_in_cells = 0.0;      ///< of a field, where the peer is not exact
};

struct ProblemTimes {
    std::string name;
    std::size_t queries = 0;
    std::string technique;  ///< what nearfield answered by
    benchmark::Spread nearfield_ms;
    std::vector<PeerTimes> peers;

    /// The median of the quickest peer that gives the whole answer, exactly; nothing where there is
    /// none.
    [[nodiscard]] std::optional<double> quickest(benchmark::Spread PeerTimes::*times) const;
};

/// Compares the answers of nearfield and all peers that have one, then measures them in turns.
/// Throws std::runtime_error where answers do not agree: then nothing is worth measuring.
[[nodiscard]] ProblemTimes race(const Problem& problem, Context& context);

}  // namespace nearfield::peers
