#pragma once

#include <nearfield/portable_math.hpp>

#include <cstddef>
#include <span>

namespace nearfield::geometry::kernels {

/// A good number of angles to ask for at once, for vectors of any width.
inline constexpr std::size_t angles_at_once = 16;

/// Writes sine_cosine() of each angle, bit for bit, computing several at the same time: those of
/// one alone have to be waited for. Precondition: at least
/// as many results as angles.
void find_sines_cosines(std::span<const double> angles, std::span<SineCosine> results);

}  // namespace nearfield::geometry::kernels
