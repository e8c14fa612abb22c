#pragma once

#include <engine/base/interruption.hpp>
#include <engine/geometry/overlap.hpp>
#include <engine/queries/grid.hpp>
#include <nearfield/result.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nearfield::queries {

/// The regions of a query: boxes outside of which nothing can happen, and their grids. Reuses its
/// memory from query to query.
class Regions {
public:
    /// Starts over with this grid, whose region the result states already.
    void set(const Grid& grid);
    /// Starts over with boxes that cover the chains, each grown by `grow` on every side, as far as
    /// they lie in `within`, and states their regions in the result. Cells are the result's.
    void cover(const std::vector<geometry::Chain>& chains, double grow, const geometry::Box& within,
               ResultSummary& result);

    [[nodiscard]] const std::vector<geometry::Box>& boxes() const { return boxes_; }
    [[nodiscard]] const std::vector<Grid>& grids() const { return grids_; }  ///< by box

    [[nodiscard]] double cells() const;
    /// Number of tiles of at most `side` x `side` cells.
    [[nodiscard]] double tiles(double side) const;
    /// Throws StatusException (too_large) if a side exceeds what a Region can state.
    void require_sides(std::uint32_t query, double tolerance) const;
    /// Calls `use(tile)` for tiles of at most `side` x `side` cells, row by row, that cover the
    /// grids; each has a halo of cells around it.
    template <class Use>
    void for_tiles(std::uint32_t side, std::uint32_t halo, const Use& use) const;

private:
    void make_grids(ResultSummary& result);

    std::vector<geometry::Box> boxes_;
    std::vector<Grid> grids_;
};

/// Adds what a search of hierarchies found, and took, to the statistics of a result.
inline void count_chains(const geometry::Effort& effort, const std::vector<geometry::Chain>& chains,
                         ResultSummary& result) {
    result.localization.nodes_evaluated += effort.nodes_evaluated;
    result.localization.pairs_rejected += effort.pairs_rejected;
    for (const geometry::Chain& chain : chains) {
        result.localization.edges_kept += chain.count;
    }
}

template <class Use>
void Regions::for_tiles(std::uint32_t side, std::uint32_t halo, const Use& use) const {
    const auto drawn = [&](std::uint64_t cells) {
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(side, cells)) + 2 * halo;
    };
    for (std::uint32_t region = 0; region < grids_.size(); ++region) {
        const Grid& grid = grids_[region];
        for (std::uint64_t row = 0; row < grid.height; row += side) {
            checkpoint();
            for (std::uint64_t column = 0; column < grid.width; column += side) {
                use(Tile{region, grid, column, row, drawn(grid.width - column),
                         drawn(grid.height - row), halo});
            }
        }
    }
}

}  // namespace nearfield::queries
