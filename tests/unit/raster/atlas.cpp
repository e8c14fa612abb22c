#include <engine/raster/atlas.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace nearfield::raster {
namespace {

std::vector<AtlasPlace> pack(AtlasPacker& packer, const std::vector<TileSize>& sizes) {
    std::vector<std::uint32_t> order;
    std::vector<device_input::PlannedTile> tiles;
    for (const TileSize& size : sizes) {
        order.push_back(static_cast<std::uint32_t>(tiles.size()));
        device_input::PlannedTile& tile = tiles.emplace_back();
        tile.width = size.width;
        tile.height = size.height;
    }
    std::vector<AtlasPlace> places(sizes.size());
    packer.pack(order, tiles, places);
    return places;
}

TEST(AtlasPacker, TilesOfATileBatchNeverOverlapAndStayInTheImage) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        const std::uint32_t largest = 64U << (seed % 3);
        std::vector<TileSize> tiles(1 + random() % 200);
        for (TileSize& tile : tiles) {
            tile = {1 + static_cast<std::uint32_t>(random() % largest),
                    1 + static_cast<std::uint32_t>(random() % (seed % 2 == 0 ? largest : 8))};
        }
        AtlasPacker packer;
        packer.begin(largest);
        const std::vector<AtlasPlace> places = pack(packer, tiles);
        const std::uint32_t side = largest + atlas_gap;
        ASSERT_LE(packer.extent().width, side);
        ASSERT_LE(packer.extent().height, side);

        // Each tile with the gap right of it and above it.
        const std::uint32_t with_gap = side + atlas_gap;
        std::vector<std::vector<bool>> taken(
            packer.tile_batches(), std::vector<bool>(std::size_t{with_gap} * with_gap, false));
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            ASSERT_LT(places[i].tile_batch, packer.tile_batches());
            ASSERT_LE(places[i].x + tiles[i].width, packer.extent().width);
            ASSERT_LE(places[i].y + tiles[i].height, packer.extent().height);
            for (std::uint32_t y = 0; y < tiles[i].height + atlas_gap; ++y) {
                for (std::uint32_t x = 0; x < tiles[i].width + atlas_gap; ++x) {
                    const std::size_t pixel =
                        std::size_t{places[i].y + y} * with_gap + places[i].x + x;
                    ASSERT_FALSE(taken[places[i].tile_batch][pixel]) << "tile " << i;
                    taken[places[i].tile_batch][pixel] = true;
                }
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::raster
