#pragma once

#include <engine/grid/coverage.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/plan/tile_edges.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::cpu {

/// Computes intersections without the device (Technique::cpu). Tiles and fill rule are those of the
/// rasteriser, and edges are snapped to geometry::cpu_grid: on a device with the same grid the
/// samples and edges are identical, bit for bit. Reuses its memory between batches.
class ExactOverlap {
public:
    /// Adds the count, box and samples of a query.
    void answer(const plan::Plan& plan, const plan::PlannedQuery& planned,
                plan::SimplifiedShapes& shapes, IntersectionResult& result);

private:
    /// Finds the samples of a tile, in a_, and if with_runs, the edges of A they belong to.
    void find_common(const plan::PlannedQuery& planned, const plan::Tile& tile, bool with_runs,
                     plan::SimplifiedShapes& shapes);
    void fill(const plan::TileBoundary& boundary, const plan::Tile& tile, double slack,
              grid::Coverage& coverage);
    /// Calls `use(run of edges, word, bits)` for the words of `coverage` that each offset polygon
    /// of a boundary covers, in drawing order.
    template <class Use>
    void for_offset_polygons(const plan::TileBoundary& boundary, const plan::Tile& tile,
                             double offset, const grid::Coverage& coverage, const Use& use);
    [[nodiscard]] plan::TileSummary summarize() const;
    /// Appends the samples of a tile row by row, and the number in each row to row_counts_.
    void append_samples(const plan::PlannedQuery& planned, const plan::Tile& tile,
                        std::vector<IntersectionSample>& samples);
    /// Appends the samples of tiles side by side, row by row through all of them.
    void append_band(std::span<const plan::Tile> band, IntersectionResult& result);

    grid::Coverage a_;
    grid::Coverage b_;
    std::vector<plan::TileEdge> crossing_;
    std::vector<grid::RowSpan> spans_;
    std::vector<plan::EdgeRun> runs_;          // by cell, for common cells
    std::vector<IntersectionSample> samples_;  // of tiles side by side, tile by tile
    std::vector<std::uint32_t> row_counts_;    // by tile and row
    std::vector<std::size_t> tile_starts_;
};

}  // namespace nearfield::cpu
