#pragma once

#include <engine/device_input/current_query.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/regions.hpp>
#include <engine/raster/closest_chains.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace nearfield::raster {

/// Assigns a query's boundary points to tiles. Only areas that hold points become tiles.
class PointTiles {
public:
    /// Appends the points of `samples` that lie in `within` to the plan, and the tiles they need. A
    /// point belongs to the region that contains it, or to the nearest one if rounding left it
    /// outside all of them. `query`: in Plan::queries.
    void spread(const geometry::TransformedPolygon& a,
                const std::vector<queries::BoundaryPoint>& samples, const geometry::Box& within,
                const queries::Regions& regions, std::uint32_t query,
                device_input::CurrentQuery& current);

private:
    struct PointCell {
        std::uint64_t column = 0;
        std::uint64_t row = 0;
    };
    struct TileKey {
        std::uint32_t grid = 0;
        std::uint64_t row = 0;
        std::uint64_t column = 0;
        bool operator==(const TileKey&) const = default;
        bool operator<(const TileKey& other) const {
            return std::tie(grid, row, column) < std::tie(other.grid, other.row, other.column);
        }
    };
    /// Consecutive points in the same tile.
    struct Run {
        TileKey key;
        std::size_t first = 0;  // among those kept
        std::size_t end = 0;
        PointCell low, high;  // of their cells, both included
    };

    void find_runs(const geometry::TransformedPolygon& a,
                   const std::vector<queries::BoundaryPoint>& samples, const geometry::Box& within,
                   const queries::Regions& regions);
    void add_to_run(std::uint32_t grid, const PointCell& cell);
    void add_tiles(const std::vector<queries::Grid>& grids, std::uint32_t query,
                   device_input::Plan& plan);
    /// Shrinks a tile's cells to those of the points in it.
    static void include(const Run& run, device_input::PlannedTile& tile);

    std::uint32_t side_ = 0;                    // of the tiles, in cells
    std::vector<queries::BoundaryPoint> kept_;  // samples that lie within
    std::vector<PointCell> cells_;              // by kept sample
    std::vector<Run> runs_;                     // of them
    std::vector<TileKey> keys_;                 // of the tiles, sorted
};

/// Plans queries about points of one boundary in the field of the other, by localisation and
/// samples. Reuses its memory from query to query.
class PointPlanner {
public:
    /// Adds to the plan, and to the result what is known before rendering. An error is stated in
    /// the result and leaves the query without tiles. Throws StatusException (too_large) if the
    /// batch needs more memory than the limit.
    void plan(device_input::CurrentQuery& current, AnyResult& any);

private:
    void plan(const PenetrationQuery& query, device_input::CurrentQuery& current,
              PenetrationResult& result);
    void plan(const ContactQuery& query, device_input::CurrentQuery& current,
              ContactResult& result);
    void plan(const ClosestPointQuery& query, device_input::CurrentQuery& current,
              ClosestPointResult& result);
    void plan(const SeparationQuery& query, device_input::CurrentQuery& current,
              SeparationResult& result);
    /// Samples the chains of A; `samples` is an upper bound on their number.
    void add_deepest(const PenetrationQuery& query, double samples,
                     device_input::CurrentQuery& current, PenetrationResult& result);
    void add_near(std::uint32_t direction, double contact_distance,
                  const std::vector<geometry::Chain>& chains, double samples,
                  device_input::CurrentQuery& current, ResultSummary& result);
    void plan_closest(bool both_ways, device_input::CurrentQuery& current, ResultSummary& result);
    /// Finds the chains that can hold the closest point; returns an upper bound on their samples.
    [[nodiscard]] double find_closest(std::uint32_t direction,
                                      const device_input::CurrentQuery& current,
                                      std::vector<geometry::Chain>& chains, ResultSummary& result);
    void add_closest(std::uint32_t direction, const std::vector<geometry::Chain>& chains,
                     device_input::CurrentQuery& current, ResultSummary& result);
    /// Adds those of the samples that lie in `within`, and the tiles or regions that hold them.
    void add_samples(std::uint32_t direction, const geometry::Box& within,
                     device_input::CurrentQuery& current);

    simd::TransformedInstances tested_;
    narrowphase::OverlapTest overlap_test_;
    ClosestChains closest_;
    std::array<std::vector<geometry::Chain>, 2> chains_;  // A and B
    queries::Regions regions_;
    std::vector<queries::BoundaryPoint> samples_;
    PointTiles tiles_;
};

}  // namespace nearfield::raster
