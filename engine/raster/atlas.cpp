#include <engine/raster/atlas.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::raster {

void AtlasPacker::begin(std::uint32_t largest_side) {
    largest_side_ = largest_side + atlas_gap;
    tile_batches_ = 0;
    extent_ = {};
}

void AtlasPacker::pack(std::vector<std::uint32_t>& tiles,
                       const std::vector<device_input::PlannedTile>& all,
                       std::vector<AtlasPlace>& places) {
    if (tiles.empty()) {
        return;
    }
    std::sort(tiles.begin(), tiles.end(), [&](std::uint32_t i, std::uint32_t j) {
        return all[i].height != all[j].height ? all[i].height > all[j].height : i < j;
    });

    // Just wide enough for a square of all cells, so that a batch of small tiles gets a small
    // image.
    double cells = 0.0;
    std::uint32_t widest = 1;
    for (const std::uint32_t i : tiles) {
        const device_input::PlannedTile& tile = all[i];
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
    for (const std::uint32_t i : tiles) {
        const device_input::PlannedTile& tile = all[i];
        if (x + tile.width > shelf_width) {
            x = 0;
            y += shelf_height + atlas_gap;
            shelf_height = 0;
        }
        if (y + tile.height > largest_side_) {
            ++tile_batches_;
            x = y = shelf_height = 0;
        }
        places[i] = {tile_batches_ - 1, x, y};
        shelf_height = std::max(shelf_height, tile.height);
        extent_.width = std::max(extent_.width, x + tile.width);
        x += tile.width + atlas_gap;
        extent_.height = std::max(extent_.height, y + shelf_height);
    }
}

}  // namespace nearfield::raster
