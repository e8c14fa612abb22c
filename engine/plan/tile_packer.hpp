#pragma once

#include <engine/plan/atlas.hpp>
#include <engine/plan/plan.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Divides the tiles of a plan among tile batches, and gives those that are drawn a place in the
/// atlas. Reuses its memory from plan to plan.
class TilePacker {
public:
    /// `largest_atlas`: cells along a side.
    explicit TilePacker(std::uint32_t largest_atlas)
        : largest_atlas_(largest_atlas), atlas_(largest_atlas) {}

    void pack(Plan& plan);

private:
    void pack_drawn_tiles(Plan& plan);
    void add_compute_tile_batches(Plan& plan) const;

    /// Tiles that the same draws serve.
    struct DrawnTogether {
        std::vector<std::uint32_t> tiles;
        std::vector<TileSize> sizes;
    };

    std::uint32_t largest_atlas_;
    AtlasPacker atlas_;
    std::array<DrawnTogether, 1 + intersection_strategies> drawn_together_;
    std::vector<AtlasPlace> places_;
};

}  // namespace nearfield::plan
