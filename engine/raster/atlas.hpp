#pragma once

#include <engine/device_input/plan.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::raster {

/// Cells between two tiles. Fills reach one cell beyond their tile, offset polygons less than four.
inline constexpr std::uint32_t atlas_gap = 4;

/// A tile's position: its tile batch, and its low corner in the atlas image.
struct AtlasPlace {
    std::uint32_t tile_batch = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

struct TileSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Packs the tiles of all queries of a batch into as few atlas images as possible: shelf packing,
/// tallest tiles first, atlas_gap apart. Tiles that do not fit one image go into further tile
/// batches, each submitted with an atlas image of its own.
class AtlasPacker {
public:
    /// Forgets what was packed. Images have at most `largest_side` cells and one gap along a side,
    /// so that as many tiles fit whose sides are half of it as without gaps.
    void begin(std::uint32_t largest_side);
    /// Places some tiles, which it sorts, in tile batches after those of earlier calls. `places`:
    /// by position in `all`. Precondition: no side of a tile exceeds the largest side.
    void pack(std::vector<std::uint32_t>& tiles, const std::vector<device_input::PlannedTile>& all,
              std::vector<AtlasPlace>& places);

    [[nodiscard]] std::uint32_t tile_batches() const { return tile_batches_; }
    /// Smallest width and height that hold every tile batch.
    [[nodiscard]] TileSize extent() const { return extent_; }

private:
    std::uint32_t largest_side_ = 0;
    std::uint32_t tile_batches_ = 0;
    TileSize extent_;
};

}  // namespace nearfield::raster
