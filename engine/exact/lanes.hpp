#pragma once

#include <cstdint>
#include <cstring>

namespace nearfield::exact {

/// Two doubles that are worked on at once: the vector types of GCC and Clang, which every x86-64
/// and ARM64 processor has registers for. A comparison gives a LaneMask, all bits set where it
/// holds; `mask ? a : b` chooses by lane.
using Lanes = double __attribute__((vector_size(16)));
using LaneMask = std::int64_t __attribute__((vector_size(16)));

inline constexpr std::uint32_t lane_count = 2;

[[nodiscard]] inline Lanes load(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

inline void store(const Lanes& lanes, double* to) {
    std::memcpy(to, &lanes, sizeof lanes);
}

[[nodiscard]] inline Lanes both(double value) {
    return Lanes{value, value};
}

}  // namespace nearfield::exact
