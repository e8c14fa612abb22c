#pragma once

#include <nearfield/result.hpp>

#include <tools/peers/peer.hpp>
#include <tools/peers/problem.hpp>

#include <span>
#include <string>
#include <vector>

namespace nearfield::peers {

/// How nearfield's answers and a peer's go together.
struct Agreement {
    std::string complaint;  ///< the first query where they differ by more than they may; else empty
    double largest_difference = 0.0;
    double allowed = 0.0;  ///< where the difference is largest
};

/// Compares what `peer`, an exact one, built from `shapes`, answered with nearfield's results, each
/// within the bound that the result states (and rounding: a millionth of d):
/// - vertices: the count, and the greatest depth;
/// - boundary: the greatest depth within the bound, since samples lie elsewhere; and every record
///   of nearfield's, by asking the peer about the very point;
/// - separation: the distance;
/// - intersection test: the same answer;
/// - area: within the area of a band as wide as the bound along the boundary of what is common,
///   whose length the boundaries of both shapes near it bound;
/// - field: each value; without its sign where the peer has none.
[[nodiscard]] Agreement compare(Peer& peer, const Problem& problem,
                                std::span<const PlacedShape> shapes,
                                std::span<const AnyResult* const> results,
                                std::span<const Answer> answers);

/// The largest difference between two fields, in cells.
[[nodiscard]] double largest_field_error(const Problem& problem, std::span<const Answer> exact,
                                         std::span<const Answer> approximate);

}  // namespace nearfield::peers
