#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace nearfield::device_input {

/// The square blocks of a tile that hold samples needed by a query: at most 32 x 32 blocks with a
/// side of 8 cells, or larger in larger tiles.
class NeededBlocks {
public:
    static constexpr std::uint32_t max_along = 32;

    NeededBlocks() = default;
    NeededBlocks(std::uint32_t width, std::uint32_t height)
        : width_(width),
          height_(height),
          side_(std::max(8U, (std::max(width, height) + max_along - 1) / max_along)) {}

    /// Side of a block, in cells.
    [[nodiscard]] std::uint32_t side() const { return side_; }
    [[nodiscard]] std::uint32_t width() const { return width_; }    ///< of the tile, in cells
    [[nodiscard]] std::uint32_t height() const { return height_; }  ///< of the tile, in cells

    void add(std::uint32_t column, std::uint32_t row) {
        rows_[row / side_] |= 1U << (column / side_);
    }
    void add_all() { rows_.fill(~0U); }

    [[nodiscard]] bool empty() const {
        return std::all_of(rows_.begin(), rows_.end(), [](std::uint32_t row) { return row == 0; });
    }

    /// Returns whether any of `count` x `count` blocks, starting at (column, row), is needed and in
    /// the tile.
    [[nodiscard]] bool any(std::uint32_t column, std::uint32_t row, std::uint32_t count) const {
        if (column * side_ >= width_ || row * side_ >= height_) {
            return false;
        }
        const std::uint32_t mask = (count >= max_along ? ~0U : (1U << count) - 1U) << column;
        return std::any_of(rows_.begin() + row, rows_.begin() + std::min(row + count, max_along),
                           [mask](std::uint32_t bits) { return (bits & mask) != 0; });
    }

private:
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t side_ = 8;
    std::array<std::uint32_t, max_along> rows_{};  // one bit per block
};

}  // namespace nearfield::device_input
