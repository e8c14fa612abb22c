#include <engine/plan/atlas.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nearfield::plan {

void AtlasPacker::clear() {
    tile_batches_ = 0;
    extent_ = {};
}

void AtlasPacker::pack(const std::vector<TileSize>& tiles, std::vector<AtlasPlace>& places) {
    places.resize(tiles.size());
    if (tiles.empty()) {
        return;
    }
    order_.resize(tiles.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return tiles[i].height != tiles[j].height ? tiles[i].height > tiles[j].height : i < j;
    });

    // Just wide enough for a square of all cells, so that a batch of small tiles gets a small
    // image.
    double cells = 0.0;
    std::uint32_t widest = 1;
    for (const TileSize& tile : tiles) {
        cells += static_cast<double>(tile.width + atlas_gap) * (tile.height + atlas_gap);
        widest = std::max(widest, tile.width);
    }
    const double side =
        std::min(std::ceil(std::sqrt(cells) * 1.1), static_cast<double>(largest_side_));
    const std::uint32_t shelf_width = std::max(widest, static_cast<std::uint32_t>(side));

    ++tile_batches_;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t shelf_height = 0;
    for (const std::uint32_t i : order_) {
        if (x + tiles[i].width > shelf_width) {
            x = 0;
            y += shelf_height + atlas_gap;
            shelf_height = 0;
        }
        if (y + tiles[i].height > largest_side_) {
            ++tile_batches_;
            x = y = shelf_height = 0;
        }
        places[i] = {tile_batches_ - 1, x, y};
        shelf_height = std::max(shelf_height, tiles[i].height);
        extent_.width = std::max(extent_.width, x + tiles[i].width);
        x += tiles[i].width + atlas_gap;
        extent_.height = std::max(extent_.height, y + shelf_height);
    }
}

}  // namespace nearfield::plan
