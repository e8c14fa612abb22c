#pragma once

#include <array>

/// \file
/// The constants behind sine_cosine(), for one angle and for vectors of angles.

namespace nearfield::trigonometry {

inline constexpr double half_pi = 0x1.921fb54442d18p+0;
inline constexpr double half_pi_rest = 0x1.1a62633145c07p-54;

/// Angles of fewer quarter turns are reduced by subtracting multiples of half_pi_parts.
inline constexpr double many_quarters = 0x1p20;
/// Half of pi is their sum; the first three have 33 bits, so their products with the number of
/// quarters are exact.
inline constexpr std::array<double, 4> half_pi_parts{0x1.921fb544p+0, 0x1.0b4611a6p-34,
                                                     0x1.3198a2ep-69, 0x1.b839a252049c1p-104};

// Taylor series up to the 17th power, in powers of the squared angle, the highest first: what is
// left out is below 2^-60 of the result.

/// Of (sin x - x) / x^3.
inline constexpr std::array<double, 8> sine_series{
    1.0 / 355687428096000, -1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800,
    1.0 / 362880,          -1.0 / 5040,          1.0 / 120,        -1.0 / 6};
/// Of (cos x - 1 + x^2 / 2) / x^4.
inline constexpr std::array<double, 7> cosine_series{
    1.0 / 20922789888000, -1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800,
    1.0 / 40320,          -1.0 / 720,         1.0 / 24};

}  // namespace nearfield::trigonometry
