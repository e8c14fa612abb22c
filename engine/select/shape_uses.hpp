#pragma once

#include <engine/geometry/polygon.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::select {

/// How often each shape occurs in a batch. Keeps its memory.
class ShapeUses {
public:
    /// Forgets them, and makes room for so many shapes.
    void begin(std::size_t shapes) { entries_.assign(std::bit_ceil(2 * shapes + 1), {}); }
    void add(const geometry::Polygon& shape) {
        Entry& entry = entries_[place_of(shape)];
        entry.shape = &shape;
        ++entry.count;
    }
    [[nodiscard]] std::uint32_t count(const geometry::Polygon& shape) const {
        return entries_[place_of(shape)].count;
    }

private:
    struct Entry {
        const geometry::Polygon* shape = nullptr;
        std::uint32_t count = 0;
    };

    [[nodiscard]] std::size_t place_of(const geometry::Polygon& shape) const {
        constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
        const std::uint64_t hash = factor * std::bit_cast<std::uintptr_t>(&shape);
        std::size_t place = (hash >> 32U) & (entries_.size() - 1);
        while (entries_[place].shape != nullptr && entries_[place].shape != &shape) {
            place = (place + 1) & (entries_.size() - 1);
        }
        return place;
    }

    std::vector<Entry> entries_;  // a hash table; its size is a power of two
};

}  // namespace nearfield::select
