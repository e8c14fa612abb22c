#pragma once

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace nearfield::test {

/// The number of random cases in a test: `usual`, or the environment variable NEARFIELD_TEST_CASES.
inline int random_cases(int usual) {
    const char* const asked = std::getenv("NEARFIELD_TEST_CASES");
    return asked == nullptr ? usual : std::atoi(asked);
}

/// 0, or the environment variable NEARFIELD_TEST_FIRST.
inline int first_case() {
    const char* const asked = std::getenv("NEARFIELD_TEST_FIRST");
    return asked == nullptr ? 0 : std::atoi(asked);
}

/// Calls `check(random)` once per case, each with its own random number generator. Failure traces
/// contain the seed and the case; the environment variable NEARFIELD_TEST_FIRST selects the first
/// case.
template <class Check>
void for_each_case(std::uint64_t seed, int usual, const Check& check) {
    const int first = first_case();
    const int cases = random_cases(usual);
    for (int i = first; i < first + cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " case " + std::to_string(i));
        Random random(seed + static_cast<std::uint64_t>(i));
        check(random);
    }
}

}  // namespace nearfield::test
