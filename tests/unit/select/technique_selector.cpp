#include "chooser_test.hpp"

#include <engine/plan/search_shapes.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::select {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
    costs.compute.submission = costs.compute.latency = 0.0;
    costs.cpu.answer.intersection = costs.raster.plan.intersection = {1.0, 1.0, 1.0};
    costs.compute.device.intersection = {};
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
    costs.raster.device.field = costs.compute.device.field = {1e9, 0.0, 0.0};
    const std::vector<AnyQuery> chosen = choose(costs, {penetration(0.0001), field(0.5)});
    EXPECT_EQ(technique_of(chosen[0]), Technique::raster);
    EXPECT_EQ(technique_of(chosen[1]), Technique::cpu);
}

TEST_F(ChooserTest, EquallyFastTechniquesAreTakenInTheirOrder) {
    CostModel costs = ChooserTest::costs();
    costs.raster.submission = costs.compute.submission = 0.0;
    costs.raster.latency = costs.compute.latency = 0.0;
    const WorkCost fast{1.0, 0.0, 0.0};
    const WorkCost slow{1000.0, 0.0, 0.0};
    costs.cpu.answer.points = costs.cpu.answer.intersection = costs.cpu.answer.field = slow;
    costs.raster.device.points = costs.compute.device.intersection = slow;
    costs.raster.device.intersection = costs.compute.device.points = fast;
    costs.raster.device.field = costs.compute.device.field = fast;
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

TEST_F(ChooserTest, CountsNoReadingOfWhatStaysOnTheDevice) {
    CostModel costs;
    costs.raster.device.field = {1.0, 0.0, 1.0};
    costs.compute.device.field = {1.0, 0.0, 2.0};
    costs.raster.read.field = {1.0, 0.0, 3.0};
    DistanceFieldQuery resident = field(0.1);
    resident.resident = true;
    resident.resident_features = false;
    EXPECT_EQ(technique_of(choose(costs, {resident})[0]), Technique::compute);
    resident.values = false;
    EXPECT_EQ(technique_of(choose(costs, {resident})[0]), Technique::raster);
}

TEST_F(ChooserTest, CountsShapesOfPointsOnce) {
    CostModel costs;
    costs.cpu.answer.points = {1.0, 0.0, 0.0};
    costs.raster.latency = 1e6;
    costs.compute.plan.points = {.query = 0.1, .shape = 5.0 / (small_.size() + large_.size())};
    const auto chosen_of = [&](std::size_t count) {
        return technique_of(
            choose(costs, std::vector<AnyQuery>(count, AnyQuery(penetration(0.1)))).back());
    };
    EXPECT_EQ(chosen_of(1), Technique::cpu);      // 1 microsecond against 5.1
    EXPECT_EQ(chosen_of(5), Technique::cpu);      // 5 against 5.5
    EXPECT_EQ(chosen_of(7), Technique::compute);  // 7 against 5.7, the first one too
    EXPECT_EQ(technique_of(choose(costs, std::vector<AnyQuery>(7, penetration(0.1)))[0]),
              Technique::compute);
}

TEST_F(ChooserTest, UsesADeviceForManyQueriesOfWhichEachSavesLittle) {
    CostModel costs = ChooserTest::costs();
    costs.raster.latency = 1e9;
    costs.cpu.answer.points = {.query =
                                   2.0};  // a microsecond more than by compute, which starts at 100
    costs.compute.device.points = {.query = 1.0};
    for (const AnyQuery& query : choose(costs, std::vector<AnyQuery>(2000, penetration(0.5)))) {
        ASSERT_EQ(technique_of(query), Technique::compute);
    }
}

TEST_F(ChooserTest, JudgesManyQueriesByASample) {
    CostModel costs = ChooserTest::costs();
    costs.raster.latency = 1e9;
    std::vector<AnyQuery> queries(2000, penetration(0.001));
    for (const AnyQuery& query : choose(costs, queries)) {
        ASSERT_EQ(technique_of(query), Technique::compute);
    }
    // One that matters is found wherever it is.
    costs.compute.device.points = {1e9, 0.0, 0.0};
    for (const std::size_t place : {std::size_t{0}, std::size_t{777}, queries.size() - 1}) {
        std::vector<AnyQuery> with_field = queries;
        with_field[place] = field(0.001);
        const std::vector<AnyQuery> chosen = choose(costs, with_field);
        EXPECT_EQ(technique_of(chosen[place]), Technique::compute) << place;
        EXPECT_EQ(std::count_if(
                      chosen.begin(), chosen.end(),
                      [](const AnyQuery& query) { return technique_of(query) == Technique::cpu; }),
                  1999);
    }
}

}  // namespace
}  // namespace nearfield::select
