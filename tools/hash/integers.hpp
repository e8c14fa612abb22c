#pragma once

#include <cstdint>

namespace nearfield::hash {

/// Random numbers by integer arithmetic alone (splitmix64), so that they are the same everywhere.
class Integers {
public:
    explicit Integers(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27U) * 0x94D049BB133111EB;
        return z ^ z >> 31U;
    }
    /// From 0 to `count` - 1.
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>((next() >> 32U) * count >> 32U);
    }
    /// A multiple of 2^-52 in [low, low + length).
    double from(double low, double length) {
        return low + length * (static_cast<double>(next() >> 12U) * 0x1p-52);
    }

private:
    std::uint64_t state_;
};

}  // namespace nearfield::hash
