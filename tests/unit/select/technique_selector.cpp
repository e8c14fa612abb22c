#include <engine/plan/search_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <engine/select/technique_selector.hpp>
#include <engine/select/work.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <array>
#include <limits>
#include <vector>

namespace nearfield::select {
namespace {

using geometry::Polygon;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

Technique technique_of(const AnyQuery& query) {
    return std::visit([](const auto& asked) { return asked.technique; }, query);
}

class ChooserTest : public testing::Test {
protected:
    void SetUp() override {
        Random random(1);
        ASSERT_TRUE(small_.assign(test::star(random, 12, 0.5)).ok());
        ASSERT_TRUE(large_.assign(test::coast(random, 4000, 0.2)).ok());
    }

    [[nodiscard]] plan::FindShape find() const {
        return [this](ShapeHandle handle) -> const Polygon* {
            return handle.index == 0 ? &small_ : handle.index == 1 ? &large_ : nullptr;
        };
    }

    static PenetrationQuery penetration(double tolerance) {
        PenetrationQuery query;
        query.a.shape = {0, 0};
        query.b = {{1, 0}, {{0.4, 0.1}, 0.3}};
        query.tolerance = tolerance;
        return query;
    }
    static DistanceFieldQuery field(double tolerance) {
        DistanceFieldQuery query;
        query.b.shape = {1, 0};
        query.tolerance = tolerance;
        query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        return query;
    }

    std::vector<AnyQuery> choose(const CostModel& costs, std::vector<AnyQuery> queries,
                                 std::uint64_t largest_range = std::uint64_t{1} << 27U) const {
        std::vector<plan::QueryShapes> shapes;
        plan::find_shapes(queries, find(), shapes);
        TechniqueSelector(costs, {}, largest_range).choose(queries, shapes);
        return queries;
    }

    /// A device that is fast after a fixed cost, and a processor without a fixed cost.
    static CostModel costs() {
        CostModel costs;
        costs.raster.submission = costs.compute.submission = 100.0;
        costs.cpu.points = costs.cpu.closest = costs.cpu.intersection = costs.cpu.field =
            costs.cpu.features = {1.0, 0.01, 1.0};
        costs.raster.points = costs.raster.field = {1.0, 0.01, 0.01};
        costs.compute.points = costs.compute.field = {1.0, 0.01, 0.02};
        return costs;
    }

    Polygon small_;
    Polygon large_;
};

TEST_F(ChooserTest, LeavesWhatIsAskedForByName) {
    std::vector<AnyQuery> queries;
    for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
        PenetrationQuery query = penetration(0.001);
        query.technique = technique;
        queries.emplace_back(query);
    }
    const std::vector<AnyQuery> chosen = choose(costs(), queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        EXPECT_EQ(technique_of(chosen[i]), technique_of(queries[i]));
    }
}

TEST_F(ChooserTest, AvoidsComputeWhereItsBuffersAreTooSmall) {
    CostModel costs = ChooserTest::costs();
    costs.compute.submission = 0.0;
    costs.cpu.intersection = costs.raster.intersection = {1.0, 1.0, 1.0};
    costs.compute.intersection = {};
    IntersectionQuery overlap;
    overlap.a.shape = {0, 0};
    overlap.b.shape = {1, 0};
    overlap.tolerance = 0.01;
    const std::uint64_t needed = plan::max_shape_bytes(small_, large_);
    EXPECT_EQ(technique_of(choose(costs, {overlap}, needed)[0]), Technique::compute);
    EXPECT_NE(technique_of(choose(costs, {overlap}, needed - 1)[0]), Technique::compute);
}

TEST_F(ChooserTest, PaysForASubmissionOnlyWhereItIsWorthIt) {
    const std::vector<AnyQuery> few = choose(costs(), {penetration(0.5)});
    EXPECT_EQ(technique_of(few[0]), Technique::cpu);
    const std::vector<AnyQuery> fine = choose(costs(), {penetration(0.0001)});
    EXPECT_EQ(technique_of(fine[0]), Technique::raster);
    const std::vector<AnyQuery> many =
        choose(costs(), std::vector<AnyQuery>(1000, penetration(0.5)));
    for (const AnyQuery& query : many) {
        ASSERT_EQ(technique_of(query), Technique::raster);
    }
    // If another query pays the fixed cost, the device is worth it for a few too.
    PenetrationQuery payer = penetration(0.5);
    payer.technique = Technique::raster;
    EXPECT_EQ(technique_of(choose(costs(), {payer, penetration(0.5)})[1]), Technique::raster);
}

TEST_F(ChooserTest, WhatADeviceWouldLoseOnOneQueryKeepsNoOtherFromIt) {
    CostModel costs = ChooserTest::costs();
    costs.raster.field = costs.compute.field = {1e9, 0.0, 0.0};
    const std::vector<AnyQuery> chosen = choose(costs, {penetration(0.0001), field(0.5)});
    EXPECT_EQ(technique_of(chosen[0]), Technique::raster);
    EXPECT_EQ(technique_of(chosen[1]), Technique::cpu);
}

TEST_F(ChooserTest, EquallyFastTechniquesAreTakenInTheirOrder) {
    CostModel costs = ChooserTest::costs();
    costs.raster.submission = costs.compute.submission = 0.0;
    const WorkCost fast{1.0, 0.0, 0.0};
    const WorkCost slow{1000.0, 0.0, 0.0};
    costs.cpu.points = costs.cpu.intersection = costs.cpu.field = slow;
    costs.raster.points = costs.compute.intersection = slow;
    costs.raster.intersection = costs.compute.points = fast;
    costs.raster.field = costs.compute.field = fast;
    // One query is faster by compute and one by raster, so both are used; the third one is as fast
    // by either.
    IntersectionQuery overlap;
    overlap.a.shape = {0, 0};
    overlap.b = {{1, 0}, {{0.4, 0.1}, 0.3}};
    overlap.tolerance = 0.01;
    const std::vector<AnyQuery> chosen = choose(costs, {penetration(0.01), overlap, field(0.01)});
    EXPECT_EQ(technique_of(chosen[0]), Technique::compute);
    EXPECT_EQ(technique_of(chosen[1]), Technique::raster);
    EXPECT_EQ(technique_of(chosen[2]), Technique::raster);
}

TEST_F(ChooserTest, AsksNoTechniqueForWhatItHasNoAnswerTo) {
    DistanceFieldQuery blended = field(0.1);
    blended.gradients = true;
    blended.gradient = GradientMethod::blended;
    const std::vector<AnyQuery> chosen = choose(costs(), {blended, field(0.5)});
    EXPECT_EQ(technique_of(chosen[0]), Technique::raster);
}

TEST_F(ChooserTest, TakesQueriesThatWillBeRefused) {
    PenetrationQuery unknown = penetration(0.1);
    unknown.b.shape = {7, 0};
    DistanceFieldQuery without_rectangle = field(0.1);
    without_rectangle.rectangle.reset();
    std::vector<AnyQuery> queries{unknown, without_rectangle};
    for (const double tolerance : {0.0, -1.0, infinity, -infinity, std::nan("")}) {
        queries.emplace_back(penetration(tolerance));
        queries.emplace_back(field(tolerance));
    }
    for (const AnyQuery& query : choose(costs(), queries)) {
        EXPECT_NE(technique_of(query), Technique::automatic);
    }
}

/// Zero, or a random cost on a logarithmic scale.
double random_cost(Random& random) {
    return random.whole(0, 3) == 0 ? 0.0 : random.scale(1e-3, 10.0);
}

TechniqueCost random_technique(Random& random) {
    TechniqueCost cost;
    cost.submission = random.scale(1.0, 1e5);
    for (WorkCost TechniqueCost::*const kind :
         {&TechniqueCost::points, &TechniqueCost::closest, &TechniqueCost::intersection,
          &TechniqueCost::field, &TechniqueCost::features}) {
        cost.*kind = {random_cost(random), random_cost(random), random_cost(random)};
    }
    return cost;
}

TEST_F(ChooserTest, IsNeverSlowerByItsModelThanOneTechniqueForAll) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        CostModel costs;
        for (TechniqueCost CostModel::*const technique :
             {&CostModel::raster, &CostModel::compute, &CostModel::cpu}) {
            costs.*technique = random_technique(random);
        }
        costs.cpu.submission = 0.0;
        std::vector<AnyQuery> queries;
        for (int i = random.whole(1, 6); i > 0; --i) {
            const double tolerance = random.scale(1e-3, 0.5);
            queries.emplace_back(penetration(tolerance));
            queries.emplace_back(field(tolerance));
        }
        const auto time_of = [&](const std::vector<AnyQuery>& batch) {
            std::array<bool, 3> used{};
            double time = 0.0;
            for (const AnyQuery& query : batch) {
                const Technique technique = technique_of(query);
                const TechniqueCost& cost = technique == Technique::raster    ? costs.raster
                                            : technique == Technique::compute ? costs.compute
                                                                              : costs.cpu;
                bool& paid = used[static_cast<std::size_t>(technique) - 1];
                time += (paid ? 0.0 : cost.submission) +
                        select::work_of(query, &small_, large_).time(cost);
                paid = true;
            }
            return time;
        };
        const double chosen = time_of(choose(costs, queries));
        for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
            std::vector<AnyQuery> uniform = queries;
            bool all = true;
            for (AnyQuery& query : uniform) {
                std::visit([&](auto& asked) { asked.technique = technique; }, query);
                all = all && plan::answers(technique, query);
            }
            if (all) {
                EXPECT_LE(chosen, time_of(uniform) * (1.0 + 1e-12)) << to_string(technique);
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::select
