#pragma once

#include <cstddef>
#include <cstdint>

namespace nearfield::device_input {

/// What the device is asked about all instances of a world, many times at once.
enum class WorldQuestion : std::uint8_t {
    rays,     ///< the first hit of a segment
    nearest,  ///< the nearest instance, or edge, of a point
    poses,    ///< whether a shape at a pose meets any instance
};
inline constexpr std::size_t world_questions = 3;

}  // namespace nearfield::device_input
