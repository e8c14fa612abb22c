#pragma once

#include <engine/exact/coverage.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/plan/tile_edges.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Intersections without the device (Technique::cpu): the tiles, the snapped edges and the fill
/// rule are the raster's, so the samples and edges are, too, bit for bit. Keeps its memory from
/// batch to batch.
class ExactOverlap {
public:
    /// Adds count, box and samples of a query.
    void answer(const plan::Plan& plan, const plan::PlannedQuery& planned,
                plan::SimplifiedShapes& shapes, IntersectionResult& result);

private:
    /// Finds the samples of a tile, into a_; with_runs: and which edges of A they belong to.
    void find_common(const plan::Plan& plan, const plan::PlannedQuery& planned,
                     const plan::Tile& tile, bool with_runs, plan::SimplifiedShapes& shapes);
    void fill(const plan::TileBoundary& boundary, const plan::Tile& tile, double slack,
              geometry::SubpixelGrid grid, exact::Coverage& coverage);
    /// Calls `use(run of edges, word, bits)` for what each offset polygon of a boundary covers of
    /// the words of `coverage`, in the order they would be drawn in.
    template <class Use>
    void for_offset_polygons(const plan::TileBoundary& boundary, const plan::Tile& tile,
                             double offset, geometry::SubpixelGrid grid,
                             const exact::Coverage& coverage, const Use& use);
    [[nodiscard]] plan::TileSummary summarize() const;
    /// Appends the samples of a tile row by row, and how many each row has to row_counts_.
    void append_samples(const plan::PlannedQuery& planned, const plan::Tile& tile,
                        std::vector<IntersectionSample>& samples);
    /// Appends the samples of tiles side by side, row by row through all of them.
    void append_band(std::span<const plan::Tile> band, IntersectionResult& result);

    exact::Coverage a_;
    exact::Coverage b_;
    std::vector<plan::TileEdge> crossing_;
    std::vector<exact::RowSpan> spans_;
    std::vector<plan::EdgeRun> runs_;          // by cell, where it is common
    std::vector<IntersectionSample> samples_;  // of tiles side by side, tile by tile
    std::vector<std::uint32_t> row_counts_;    // by tile and row
    std::vector<std::size_t> tile_starts_;
};

}  // namespace nearfield
