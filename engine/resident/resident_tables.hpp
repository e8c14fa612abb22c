#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/plan/resident_outputs.hpp>

#include <array>
#include <bit>
#include <cstdint>

/// Appends data to the tables of the resident outputs.
namespace nearfield::resident {

/// Appends a structure of 32-bit words unchanged.
template <class Structure>
void add_words(const Structure& structure, plan::ResidentOutputs& resident) {
    using Words = std::array<std::uint32_t, sizeof(Structure) / sizeof(std::uint32_t)>;
    const auto words = std::bit_cast<Words>(structure);
    resident.tables.insert(resident.tables.end(), words.begin(), words.end());
}

/// Appends the rings of a polygon.
inline plan::RingTable add_rings(const geometry::Polygon& polygon,
                                 plan::ResidentOutputs& resident) {
    const plan::RingTable rings{static_cast<std::uint32_t>(resident.tables.size()),
                                polygon.ring_count()};
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        resident.tables.push_back(polygon.ring_begin(ring));
    }
    resident.tables.push_back(polygon.size());
    return rings;
}

}  // namespace nearfield::resident
