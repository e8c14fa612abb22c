#pragma once

#include <cstdint>
#include <random>

namespace nearfield::benchmark {

/// A seeded random number generator that is identical with every standard library, so that a row of
/// the table is the same work everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [low, high).
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace nearfield::benchmark
