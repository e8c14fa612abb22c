#pragma once

#include <engine/queries/tile_edges.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <vector>

namespace nearfield::raster {

/// Writes lists of edges into one array of 2-vectors, in the layout that the compute shaders read.
class EdgeListWriter {
public:
    struct Entry {
        float x = 0.0F;
        float y = 0.0F;
    };

    /// Starts a new array.
    void clear() { geometry_.clear(); }
    /// Starts a new tile: runs of edges written so far are in other coordinates and are not reused.
    void begin_tile(const queries::TileBoundary& boundary);

    /// Writes one list; position i of the list is edge i. Edges that stand for themselves are cut,
    /// in double precision, to the square |x|, |y| <= `extent` around the tile's low corner, so
    /// that every coordinate stays within what a float resolves. Nothing outside the square may
    /// matter: edges wholly outside are omitted.
    shaders::EdgeListData write(const std::vector<queries::TileEdge>& edges, double extent);

    [[nodiscard]] const std::vector<Entry>& geometry() const { return geometry_; }

private:
    /// Where an edge's run lies, valid if `tile` wrote it.
    struct WrittenRun {
        std::uint64_t tile = 0;
        std::uint32_t place = 0;
    };

    [[nodiscard]] std::uint32_t run_of(const geometry::SimplifiedEdge& edge, std::uint32_t index);
    [[nodiscard]] shaders::EdgeData describe(const queries::TileEdge& edge);
    /// Writes list_.
    shaders::EdgeListData write_list();

    const queries::TileBoundary* boundary_ = nullptr;
    std::vector<Entry> geometry_;
    std::vector<shaders::EdgeData> list_;
    std::vector<WrittenRun> runs_;  // by simplified edge
    std::uint64_t tile_ = 0;        // number of tiles begun
};

}  // namespace nearfield::raster
