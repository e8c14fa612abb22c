#pragma once

#include <nearfield/export.hpp>

#include <cstdint>

/// \file
/// Localisation (section 2.1 of the paper): the CPU finds the regions where a query can have
/// results. Settings and statistics.

namespace nearfield {

/// The bounding volumes of the hierarchies. Both give the same results within their error bounds;
/// they differ in the amount of work for the device. Neither is stored: volumes are computed when
/// needed.
enum class BoundingVolume : std::uint8_t {
    axis_aligned,  ///< axis-aligned boxes in world coordinates
    oriented,      ///< these, and boxes along the principal axes of their contents
};

/// Work counters of the localisation of one query.
struct LocalizationStatistics {
    std::uint64_t nodes_evaluated = 0;  ///< bounding volumes computed
    std::uint64_t pairs_rejected = 0;   ///< pairs of bounding volumes found to be disjoint
    std::uint64_t edges_kept = 0;       ///< edges that the technique examines
};

}  // namespace nearfield
