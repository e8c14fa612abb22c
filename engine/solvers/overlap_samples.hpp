#pragma once

#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/overlap_regions.hpp>
#include <engine/queries/tile_edges.hpp>
#include <engine/solvers/coverage.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Answers intersections. Tiles and fill rule are those of the rasteriser, and edges are snapped to
/// geometry::cpu_grid: on a device with the same grid the samples and edges are identical, bit for
/// bit. Reuses its memory between batches.
class OverlapSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                IntersectionResult& result);

private:
    /// Adds the count, box and samples of the tiles of a query.
    void find_samples(const queries::CheckedQuery& query, queries::SimplifiedShapes& shapes,
                      IntersectionResult& result);
    /// Finds the samples of a tile, in a_, and if with_runs, the edges of A they belong to.
    void find_common(const queries::CheckedQuery& query, const queries::Tile& tile, bool with_runs,
                     queries::SimplifiedShapes& shapes);
    void fill(const queries::TileBoundary& boundary, const queries::Tile& tile, double slack,
              Coverage& coverage);
    /// Calls `use(run of edges, word, bits)` for the words of `coverage` that each offset polygon
    /// of a boundary covers, in drawing order.
    template <class Use>
    void for_offset_polygons(const queries::TileBoundary& boundary, const queries::Tile& tile,
                             double offset, const Coverage& coverage, const Use& use);
    [[nodiscard]] shaders::TileSummary summarize() const;
    /// Appends the samples of a tile row by row, and the number in each row to row_counts_.
    void append_samples(const queries::CheckedQuery& query, const queries::Tile& tile,
                        std::vector<IntersectionSample>& samples);
    /// Appends the samples of tiles side by side, row by row through all of them.
    void append_band(std::span<const queries::Tile> band, IntersectionResult& result);

    queries::OverlapRegions overlaps_;
    std::vector<queries::Tile> tiles_;
    narrowphase::OverlapTest overlap_test_;
    Coverage a_;
    Coverage b_;
    std::vector<queries::TileEdge> crossing_;
    std::vector<RowSpan> spans_;
    std::vector<queries::EdgeRun> runs_;       // by cell, for common cells
    std::vector<IntersectionSample> samples_;  // of tiles side by side, tile by tile
    std::vector<std::uint32_t> row_counts_;    // by tile and row
    std::vector<std::size_t> tile_starts_;
};

}  // namespace nearfield::solvers
