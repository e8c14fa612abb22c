#include <engine/plan/planner.hpp>
#include <engine/plan/tile_batch.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace nearfield::plan {
namespace {

// Two squares of 10 x 10 whose intersection is 5 x 10.
TileBatch tile_batch_of(const std::vector<std::pair<IntersectionStrategy, double>>& asked) {
    geometry::Polygon square;
    EXPECT_TRUE(square.assign(std::vector<Ring>{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}).ok());
    std::vector<AnyQuery> queries;
    for (const auto& [strategy, tolerance] : asked) {
        IntersectionQuery query;
        query.technique = Technique::raster;
        query.b.pose.translation = {5, 0};
        query.tolerance = tolerance;
        query.records = false;
        query.strategy = strategy;
        queries.emplace_back(query);
    }
    PlanLimits limits;
    limits.memory = std::uint64_t{1} << 34U;
    limits.largest_atlas = 4096;
    Planner planner(limits);
    Plan plan;
    std::vector<AnyResult> results;
    const std::vector<QueryShapes> shapes(queries.size(), {&square, &square});
    planner.plan(queries, shapes, plan, results);
    TileBatchBuilder builder(limits.subpixel);
    TileBatch round;
    builder.build(plan, 0, round);
    return round;
}

TEST(PlanWatch, LargeTilesOfStencilAndDepthOnly) {
    using S = IntersectionStrategy;
    constexpr double fine = 0.02;
    constexpr double coarse = 0.2;
    const TileBatch round = tile_batch_of({{S::stencil, fine},
                                           {S::blend, fine},
                                           {S::logic_op, fine},
                                           {S::depth, fine},
                                           {S::stencil, coarse},
                                           {S::depth, coarse}});
    std::set<std::uint32_t> tiles;
    for (const WatchedTile& watched : round.watched) {
        EXPECT_TRUE(watched.strategy == S::stencil || watched.strategy == S::depth);
        const TileData& tile = round.tiles[watched.tile];
        EXPECT_GE(tile.width * tile.height, 128U * 128U);
        EXPECT_EQ(watched.part_a, Part::volume);
        EXPECT_EQ(watched.a.count, 6U);
        EXPECT_TRUE(tiles.insert(watched.tile).second);
    }
    EXPECT_EQ(tiles.size(), 2U);
    // The other four tiles are drawn together, and no tile twice.
    std::uint32_t vertices = 0;
    for (std::size_t strategy = 0; strategy < intersection_strategies; ++strategy) {
        for (const OverlapStep step : {OverlapStep::volume_a, OverlapStep::watched_a}) {
            vertices += round.meshes.range(overlaps_of(static_cast<S>(strategy), step)).count;
        }
    }
    EXPECT_EQ(vertices, 6U * 6U);
}

TEST(PlanWatch, TheLargestIfThereAreTooMany) {
    std::vector<std::pair<IntersectionStrategy, double>> many(
        60, {IntersectionStrategy::stencil, 0.04});
    for (const unsigned i : {7U, 20U, 31U, 59U}) {
        many[i].second = 0.02;
    }
    const TileBatch round = tile_batch_of(many);
    ASSERT_EQ(round.watched.size(), max_watched);
    std::uint32_t large = 0;
    for (const WatchedTile& watched : round.watched) {
        large = std::max(large, round.tiles[watched.tile].width);
        EXPECT_GE(round.tiles[watched.tile].width * 3, large * 2);
        EXPECT_GT(round.tiles[watched.tile].height, 300U);
    }
}

}  // namespace
}  // namespace nearfield::plan
