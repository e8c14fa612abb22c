#pragma once

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Minimum side of an atlas image, in cells, without its last gap.
inline constexpr std::uint32_t smallest_atlas = 256;
/// The same of the largest. Twice as many cells fit into a viewport of any device.
inline constexpr std::uint32_t largest_atlas_side = 2048;
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
    /// Images have at most `largest_side` cells and one gap along a side, so that as many tiles fit
    /// whose sides are half of it as without gaps.
    explicit AtlasPacker(std::uint32_t largest_side) : largest_side_(largest_side + atlas_gap) {}

    /// Forgets what was packed.
    void clear();
    /// Places each tile, in tile batches after those of earlier calls. Precondition: no side of a
    /// tile exceeds the largest side.
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
