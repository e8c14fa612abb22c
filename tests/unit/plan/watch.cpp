#include <engine/plan/planner.hpp>
#include <engine/plan/tile_batch.hpp>

#include <gtest/gtest.h>

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
    std::set<std::uint32_t> queries;
    for (std::size_t strategy = 0; strategy < intersection_strategies; ++strategy) {
        for (const TileDraw& draw : round.overlap_draws[strategy]) {
            const bool decides =
                static_cast<S>(strategy) == S::stencil || static_cast<S>(strategy) == S::depth;
            const bool large = draw.width * draw.height >= 128 * 128;
            EXPECT_EQ(draw.watch != no_watch, decides && large) << strategy;
            if (draw.watch != no_watch) {
                EXPECT_LT(draw.watch, round.watched);
                EXPECT_TRUE(queries.insert(draw.watch).second);
            }
        }
    }
    EXPECT_EQ(queries.size(), 2U);
    EXPECT_EQ(round.watched, 2U);
}

TEST(PlanWatch, NoMoreThanThereAreQueries) {
    const std::vector<std::pair<IntersectionStrategy, double>> many(
        400, {IntersectionStrategy::stencil, 0.04});
    const TileBatch round = tile_batch_of(many);
    EXPECT_EQ(round.watched, max_watched);
    std::uint32_t watched = 0;
    for (const TileDraw& draw : round.overlap_draws[0]) {
        watched += draw.watch != no_watch ? 1 : 0;
    }
    EXPECT_EQ(watched, round.watched);
}

}  // namespace
}  // namespace nearfield::plan
