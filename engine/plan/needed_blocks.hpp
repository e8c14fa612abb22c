#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace nearfield::plan {

/// Which square blocks of a tile hold samples that something is asked about: at most 32 x 32 blocks
/// of 8 cells a side, or of more where the tile is larger.
class NeededBlocks {
public:
    static constexpr std::uint32_t most_along = 32;

    NeededBlocks() = default;
    NeededBlocks(std::uint32_t width, std::uint32_t height)
        : width_(width),
          height_(height),
          side_(std::max(8U, (std::max(width, height) + most_along - 1) / most_along)) {}

    /// Cells along a side of a block.
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

    /// True where one of `count` x `count` blocks from (column, row) on is needed and in the tile.
    [[nodiscard]] bool any(std::uint32_t column, std::uint32_t row, std::uint32_t count) const {
        if (column * side_ >= width_ || row * side_ >= height_) {
            return false;
        }
        const std::uint32_t mask = (count >= most_along ? ~0U : (1U << count) - 1U) << column;
        return std::any_of(rows_.begin() + row, rows_.begin() + std::min(row + count, most_along),
                           [mask](std::uint32_t bits) { return (bits & mask) != 0; });
    }

private:
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t side_ = 8;
    std::array<std::uint32_t, most_along> rows_{};  // a bit a block
};

}  // namespace nearfield::plan
