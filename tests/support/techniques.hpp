#pragma once

#include <nearfield/query.hpp>

#include <array>
#include <span>

namespace nearfield::test {

/// What a query can ask for: Technique::automatic, then what the library was built with, the CPU
/// last.
inline constexpr std::array any_technique{
    Technique::automatic,
#ifdef NEARFIELD_HAS_RASTER
    Technique::raster,
#endif
    Technique::compute,
    Technique::cpu,
};
inline constexpr std::span<const Technique> every_technique = std::span(any_technique).subspan(1);
/// Those that need a device.
inline constexpr std::span<const Technique> device_techniques =
    every_technique.first(every_technique.size() - 1);
inline constexpr bool has_raster = every_technique.front() == Technique::raster;

}  // namespace nearfield::test
