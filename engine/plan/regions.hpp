#pragma once

#include <engine/localize/overlap.hpp>
#include <engine/plan/current_query.hpp>
#include <engine/plan/grid.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// The regions of a query: boxes outside of which nothing can happen, and their grids. Reuses its
/// memory from query to query.
class Regions {
public:
    /// Starts over with this grid, whose region the result states already.
    void set(const Grid& grid);
    /// Starts over with boxes that cover the chains, each grown by `grow` on every side, as far as
    /// they lie in `within`, and states their regions in the result. Cells are the result's.
    void cover(const std::vector<localize::Chain>& chains, double grow, const geometry::Box& within,
               ResultSummary& result);

    [[nodiscard]] const std::vector<geometry::Box>& boxes() const { return boxes_; }
    [[nodiscard]] const std::vector<Grid>& grids() const { return grids_; }  ///< by box

    [[nodiscard]] double cells() const;
    /// Number of tiles of at most `side` x `side` cells.
    [[nodiscard]] double tiles(double side) const;
    /// Memory for `masks` bit masks of the grids by the compute technique, one bit per cell in rows
    /// of whole words.
    [[nodiscard]] double bytes_of_masks(int masks, double largest_tile) const;
    /// Throws StatusException (too_large) if a side exceeds what a Region can state.
    void require_sides(std::uint32_t query, double tolerance) const;
    /// Appends tiles of at most `side` x `side` cells, row by row, that cover the grids; each is
    /// drawn with a halo of cells around it.
    void cut_into_tiles(std::uint32_t query, TileKind kind, std::uint32_t side, std::uint32_t halo,
                        std::vector<Tile>& tiles) const;

private:
    void make_grids(ResultSummary& result);

    std::vector<geometry::Box> boxes_;
    std::vector<Grid> grids_;
};

}  // namespace nearfield::plan
