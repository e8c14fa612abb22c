#pragma once

#include <engine/geometry/polygon.hpp>
#include <nearfield/cost.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::select {

/// A shape and the queries of one kind that have it: what preparing it takes, they share.
struct ShapeUse {
    const geometry::Polygon* shape = nullptr;
    WorkCost QueryCosts::*kind = nullptr;
    std::uint32_t count = 0;  ///< of a query of a shape with itself, two
    /// Of these, how many each technique answers, by its index.
    std::array<std::uint32_t, 3> chosen{};
};

/// The shapes of a batch, in a hash table. Keeps its memory.
class ShapeUses {
public:
    /// Forgets them, and makes room for so many.
    void begin(std::size_t shapes) {
        uses_.clear();
        uses_.reserve(shapes);
        table_.assign(std::bit_ceil(2 * shapes + 1), none);
    }
    /// Counts a use, and returns the index of all of the shape's.
    std::uint32_t add(const geometry::Polygon& shape, WorkCost QueryCosts::*kind) {
        std::uint32_t& index = table_[place_of(shape, kind)];
        if (index == none) {
            index = static_cast<std::uint32_t>(uses_.size());
            uses_.push_back({&shape, kind});
        }
        ++uses_[index].count;
        return index;
    }
    [[nodiscard]] ShapeUse& operator[](std::uint32_t index) { return uses_[index]; }
    [[nodiscard]] const ShapeUse& operator[](std::uint32_t index) const { return uses_[index]; }
    [[nodiscard]] std::span<ShapeUse> all() { return uses_; }

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    [[nodiscard]] std::size_t place_of(const geometry::Polygon& shape,
                                       WorkCost QueryCosts::*kind) const {
        constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
        const std::uint64_t hash = factor * std::bit_cast<std::uintptr_t>(&shape);
        std::size_t place = (hash >> 32U) & (table_.size() - 1);
        const auto is_other = [&](std::uint32_t index) {
            return uses_[index].shape != &shape || uses_[index].kind != kind;
        };
        while (table_[place] != none && is_other(table_[place])) {
            place = (place + 1) & (table_.size() - 1);
        }
        return place;
    }

    std::vector<ShapeUse> uses_;
    std::vector<std::uint32_t> table_;  // indices; its size is a power of two
};

}  // namespace nearfield::select
