#pragma once

#include <gtest/gtest.h>
#include <tests/query/corpus.hpp>
#include <tests/query/pair.hpp>

#include <memory>
#include <string>
#include <vector>

namespace nearfield::test {

/// A pair of a random kind: ordinary ones, and those that answers get wrong most easily. They touch
/// in points or along edges, share vertices, are copies of each other or almost so, lie in holes
/// and between nested rings, differ in size by four orders of magnitude, are far from the origin or
/// far apart, or are slivers and spikes.
Pair any_hard_pair(Random& random);

/// Pairs of degenerate_shapes().
std::vector<Pair> degenerate_pairs(Context& context, Random& random, int count);

/// Hard pairs in a context, one beside the other, and what is asked about them.
struct HardPairs {
    std::vector<std::unique_ptr<PlacedPair>> pairs;  ///< of technique compute
    double tolerance = 0.0;                          ///< of all pairs
    double contact_distance = 0.0;
    double reach = 0.0;                    ///< of separations in a world
    std::vector<double> field_tolerances;  ///< for the field of each pair's B

    HardPairs(Context& context, Random& random, int count);

    /// Calls `check(index, pair)` for all pairs, and keeps those for which it fails.
    template <class Check>
    void for_each(const Check& check) const {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const CorpusKeeper keeper(pairs[i]->pair(), contact_distance);
            SCOPED_TRACE("pair " + std::to_string(i) + ", contact distance " +
                         std::to_string(contact_distance) + '\n' + describe(pairs[i]->pair()));
            check(i, *pairs[i]);
        }
    }
};

/// Asks all pair tables that the device fills about a world of the pairs, and compares each row
/// with the oracle and with the table that the CPU fills.
void check_tables(Context& context, const HardPairs& asked);

}  // namespace nearfield::test
