#pragma once

#include <tests/query/moving_pair.hpp>
#include <tests/query/query_test.hpp>

namespace nearfield::test {

class TimeOfImpactTest : public QueryTest {
protected:
    static TimeOfImpactResult ask(const MovingPair& moving, double time_bound = 1.0,
                                  std::uint32_t max_steps = TimeOfImpactQuery().max_steps);

    /// Checks the guarantees of every answer against the oracle at `moments` times.
    static TimeOfImpactResult check(const MovingPair& moving, int moments = 60,
                                    double time_bound = 1.0);
};

}  // namespace nearfield::test
