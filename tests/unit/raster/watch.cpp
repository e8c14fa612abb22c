#include <engine/device_input/planner.hpp>
#include <engine/raster/drawn_batch_builder.hpp>

#include <gtest/gtest.h>
#include <tests/support/planned_queries.hpp>

#include <algorithm>
#include <set>

namespace nearfield::raster {
namespace {

// Two squares of 10 x 10 whose intersection is 5 x 10.
std::vector<DrawnBatch> tile_batches_of(
    const std::vector<std::pair<IntersectionStrategy, double>>& asked) {
    geometry::Polygon square;
    EXPECT_TRUE(square.assign(std::vector<Ring>{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}).ok());
    std::vector<AnyQuery> queries;
    for (const auto& [strategy, tolerance] : asked) {
        IntersectionQuery query;
        query.technique = Technique::raster;
        query.b.pose.translation = {5, 0};
        query.tolerance = tolerance;
        query.summary_only = true;
        query.strategy = strategy;
        queries.emplace_back(query);
    }
    queries::QueryLimits limits;
    limits.memory = std::uint64_t{1} << 34U;
    limits.largest_atlas = 4096;
    device_input::Planner planner(limits);
    device_input::Plan plan;
    std::vector<AnyResult> results;
    const std::vector<queries::QueryShapes> shapes(queries.size(), {&square, &square});
    test::plan_all(test::checked_queries(queries, shapes, limits, results), {}, planner, plan,
                   results);
    DrawnBatchBuilder builder(limits.subpixel);
    std::vector<DrawnBatch> batches;
    const std::uint32_t count = builder.build(plan, batches);
    EXPECT_EQ(count, batches.size());
    return batches;
}

TEST(RasterWatch, LargeTilesOfStencilAndDepthOnly) {
    using S = IntersectionStrategy;
    constexpr double fine = 0.02;
    constexpr double coarse = 0.2;
    const std::vector<DrawnBatch> batches = tile_batches_of({{S::stencil, fine},
                                                             {S::blend, fine},
                                                             {S::logic_op, fine},
                                                             {S::depth, fine},
                                                             {S::stencil, coarse},
                                                             {S::depth, coarse}});
    ASSERT_EQ(batches.size(), 4U) << "each strategy has a tile batch";
    std::size_t watched_tiles = 0;
    std::uint32_t vertices = 0;
    for (const DrawnBatch& batch : batches) {
        std::set<std::uint32_t> tiles;
        for (const WatchedTile& watched : batch.watched) {
            EXPECT_TRUE(watched.strategy == S::stencil || watched.strategy == S::depth);
            const shaders::TileData& tile = batch.tiles[watched.tile];
            EXPECT_GE(tile.width * tile.height, 128U * 128U);
            EXPECT_EQ(watched.part_a, device_input::Part::volume);
            EXPECT_EQ(watched.a.count, 6U);
            EXPECT_TRUE(tiles.insert(watched.tile).second);
        }
        watched_tiles += tiles.size();
        for (std::size_t strategy = 0; strategy < intersection_strategies; ++strategy) {
            for (const OverlapStep step : {OverlapStep::volume_a, OverlapStep::watched_a}) {
                vertices += batch.meshes.range(overlaps_of(static_cast<S>(strategy), step)).count;
            }
        }
    }
    EXPECT_EQ(watched_tiles, 2U);
    // The other four tiles are drawn with the rest, and no tile twice.
    EXPECT_EQ(vertices, 6U * 6U);
}

TEST(RasterWatch, TheLargestIfThereAreTooMany) {
    std::vector<std::pair<IntersectionStrategy, double>> many(
        60, {IntersectionStrategy::stencil, 0.04});
    for (const unsigned i : {7U, 20U, 31U, 59U}) {
        many[i].second = 0.02;
    }
    const DrawnBatch batch = tile_batches_of(many).front();
    ASSERT_EQ(batch.watched.size(), max_watched);
    std::uint32_t large = 0;
    for (const WatchedTile& watched : batch.watched) {
        large = std::max(large, batch.tiles[watched.tile].width);
        EXPECT_GE(batch.tiles[watched.tile].width * 3, large * 2);
        EXPECT_GT(batch.tiles[watched.tile].height, 300U);
    }
}

}  // namespace
}  // namespace nearfield::raster
