#pragma once

#include <nearfield/result.hpp>

#include <tools/peers/peer.hpp>
#include <tools/peers/problem.hpp>

#include <span>
#include <string>
#include <vector>

namespace nearfield::peers {

/// The result of comparing nearfield's answers with a peer's.
struct Agreement {
    std::string complaint;  ///< the first query where they differ by more than allowed; else empty
    double largest_difference = 0.0;
    double allowed = 0.0;  ///< the allowance where the difference is largest
};

/// Compares the answers of `peer`, an exact one built from `shapes`, with nearfield's results, each
/// within the error bound that the result states (plus rounding: a millionth of d):
/// - vertices: the count, and the greatest depth;
/// - boundary: the greatest depth within the bound, because the samples differ; and every record of
///   nearfield's, by asking the peer about the same point;
/// - separation: the distance;
/// - intersection test: the same answer;
/// - area: within the area of a band as wide as the bound along the boundary of the intersection,
///   whose length is bounded by the lengths of both boundaries near it;
/// - field: each value; without its sign if the peer has none.
[[nodiscard]] Agreement compare(Peer& peer, const Problem& problem,
                                std::span<const PlacedShape> shapes,
                                std::span<const AnyResult* const> results,
                                std::span<const Answer> answers);

/// The largest difference between two fields, in cells.
[[nodiscard]] double largest_field_error(const Problem& problem, std::span<const Answer> exact,
                                         std::span<const Answer> approximate);

}  // namespace nearfield::peers
