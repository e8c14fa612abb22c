#pragma once

#include <cstdint>

/// \file
/// How the CPU finds where something can happen (the paper's section 2.1), and what it did.

namespace nearfield {

/// The bounding volumes of the hierarchies. Results are the same within their bounds; what changes
/// is how much is left for the device. Neither is stored: both are computed where they are needed.
enum class BoundingVolume : std::uint8_t {
    axis_aligned,  ///< boxes along the axes of the world
    oriented,      ///< these, and boxes along the principal axes of what they hold
};

/// What localisation did for one query.
struct LocalizationStatistics {
    std::uint64_t nodes_evaluated = 0;  ///< bounding volumes computed
    std::uint64_t pairs_rejected = 0;   ///< pairs of bounding volumes found apart
    std::uint64_t edges_kept = 0;       ///< edges left for the device to look at
};

}  // namespace nearfield
