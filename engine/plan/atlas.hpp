#pragma once

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Minimum side of an atlas image, in cells.
inline constexpr std::uint32_t smallest_atlas = 256;

/// A tile's position: its tile batch, and its low corner in the atlas image.
struct AtlasPlace {
    std::uint32_t round = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

struct TileSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Packs the tiles of all queries of a batch into as few atlas images as possible: shelf packing,
/// tallest tiles first. Tiles that do not fit one image go into further tile batches, each
/// submitted with an atlas image of its own.
class AtlasPacker {
public:
    explicit AtlasPacker(std::uint32_t largest_side) : largest_side_(largest_side) {}

    /// Places each tile. Precondition: no side of a tile exceeds the largest side.
    void pack(const std::vector<TileSize>& tiles, std::vector<AtlasPlace>& places);

    [[nodiscard]] std::uint32_t tile_batches() const { return tile_batches_; }
    /// Smallest width and height that hold every tile batch.
    [[nodiscard]] TileSize extent() const { return extent_; }

private:
    std::uint32_t largest_side_;
    std::uint32_t tile_batches_ = 0;
    TileSize extent_;
    std::vector<std::uint32_t> order_;
};

}  // namespace nearfield::plan
