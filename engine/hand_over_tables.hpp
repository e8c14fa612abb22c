#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/plan/hand_over.hpp>

#include <array>
#include <bit>
#include <cstdint>

/// What goes into the tables of what is handed over, behind what stands there.
namespace nearfield {

/// A structure of 32-bit words, as it is.
template <class Structure>
void add_words(const Structure& structure, plan::HandOver& hand_over) {
    using Words = std::array<std::uint32_t, sizeof(Structure) / sizeof(std::uint32_t)>;
    const auto words = std::bit_cast<Words>(structure);
    hand_over.tables.insert(hand_over.tables.end(), words.begin(), words.end());
}

/// A position as two floats.
inline void add_position(const geometry::Vector& position, plan::HandOver& hand_over) {
    add_words(std::array{static_cast<float>(position.x()), static_cast<float>(position.y())},
              hand_over);
}

/// The rings of a polygon.
inline plan::RingTable add_rings(const geometry::Polygon& polygon, plan::HandOver& hand_over) {
    const plan::RingTable rings{static_cast<std::uint32_t>(hand_over.tables.size()),
                                polygon.ring_count()};
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        hand_over.tables.push_back(polygon.ring_begin(ring));
    }
    hand_over.tables.push_back(polygon.size());
    return rings;
}

}  // namespace nearfield
