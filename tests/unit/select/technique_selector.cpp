#include "timed_batch.hpp"

#include <engine/plan/search_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <engine/select/technique_selector.hpp>
#include <engine/select/work.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
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
        costs.raster.submission = costs.compute.submission = 60.0;
        costs.raster.latency = costs.compute.latency = 40.0;
        QueryCosts& cpu = costs.cpu.answer;
        cpu.points = cpu.closest = cpu.intersection = cpu.field = cpu.features = {1.0, 0.01, 1.0};
        costs.raster.device.points = costs.raster.device.field = {1.0, 0.01, 0.01};
        costs.compute.device.points = costs.compute.device.field = {1.0, 0.01, 0.02};
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

/// Fields that the device answers in nine tenths of the CPU's time, and nothing else costs
/// anything.
CostModel nearly_as_fast(double overlap) {
    CostModel costs;
    costs.compute.device.field = {90.0, 0.0, 0.0};
    costs.cpu.answer.field = {100.0, 0.0, 0.0};
    costs.raster.plan.field = {1e6, 0.0, 0.0};
    costs.overlap = overlap;
    return costs;
}

TEST_F(ChooserTest, DividesABatchBetweenDeviceAndCpuWhereTheyWorkSideBySide) {
    const std::vector<AnyQuery> fields(19, field(0.1));
    const auto on_device = [&](const CostModel& costs) {
        const std::vector<AnyQuery> chosen = choose(costs, fields);
        return std::count_if(chosen.begin(), chosen.end(), [](const AnyQuery& query) {
            return technique_of(query) == Technique::compute;
        });
    };
    EXPECT_EQ(on_device(nearly_as_fast(0.0)), 19);
    EXPECT_EQ(on_device(nearly_as_fast(1.0)), 10);  // 900 microseconds on either side
    EXPECT_EQ(on_device(nearly_as_fast(0.5)), 10);
    CostModel slow = nearly_as_fast(1.0);
    slow.compute.device.field.query = 1000.0;
    EXPECT_EQ(on_device(slow), 1);  // 1,000 microseconds beside the CPU's 1,800
    slow.overlap = 0.05;
    EXPECT_EQ(on_device(slow), 0);
    slow.overlap = 1.0;
    slow.compute.latency = 900.0;
    EXPECT_EQ(on_device(slow), 0);
    slow.compute.latency = 0.0;
    slow.compute.plan.field.query = 101.0;  // nothing hides this
    EXPECT_EQ(on_device(slow), 0);
    CostModel close = nearly_as_fast(0.0);
    close.compute.device.field.query = 98.0;  // not worth a device
    EXPECT_EQ(on_device(close), 0);
    close.compute.device.field.query = 96.0;
    EXPECT_EQ(on_device(close), 19);
    CostModel planned = nearly_as_fast(1.0);  // nor a plan of the CPU
    planned.cpu = {.plan = planned.cpu.answer};
    EXPECT_EQ(on_device(planned), 19);
}

TEST_F(ChooserTest, CountsWhatOthersAskForByNameAsLoads) {
    const CostModel costs = nearly_as_fast(1.0);
    const auto beside = [&](Technique technique, std::size_t count) {
        DistanceFieldQuery named = field(0.1);
        named.technique = technique;
        std::vector<AnyQuery> queries(count, named);
        queries.emplace_back(field(0.1));
        return technique_of(choose(costs, queries).back());
    };
    EXPECT_EQ(beside(Technique::cpu, 3), Technique::compute);
    EXPECT_EQ(beside(Technique::compute, 3), Technique::cpu);
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
    costs.compute.plan.points = {0.1, 5.0 / (small_.size() + large_.size()), 0.0};
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

/// The CPU is chosen where the batch takes up to so much longer; and room for a 4,096th.
constexpr double preference = 1.032;

TEST_F(ChooserTest, TakesTheLeastTimeButForOneQuery) {
    int exact = 0;  // but for the preference
    constexpr int cases = 400;
    for (std::uint64_t seed = 0; seed < cases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const CostModel costs = random_model(random);
        std::vector<AnyQuery> queries;
        std::vector<Work> works;
        int open_points = 0;  // queries that share the plan of their shapes
        for (int i = random.whole(1, 7); i > 0; --i) {
            const double tolerance = random.scale(1e-3, 0.5);
            AnyQuery query = penetration(tolerance);
            if (random.whole(0, 1) == 0) {
                query = field(tolerance);
            }
            std::visit(
                [&](auto& asked) {
                    asked.technique = random.whole(0, 4) > 0   ? Technique::automatic
                                      : random.whole(0, 1) > 0 ? Technique::compute
                                                               : Technique::cpu;
                },
                query);
            queries.push_back(query);
            works.push_back(select::work_of(query, &small_, large_));
            open_points += works.back().kind == &QueryCosts::points &&
                                   technique_of(query) == Technique::automatic
                               ? 1
                               : 0;
        }
        for (std::size_t i = 0; i < works.size(); ++i) {
            if (works[i].kind == &QueryCosts::points &&
                technique_of(queries[i]) == Technique::automatic) {
                works[i].shared_edges = works[i].edges * (1.0 - 1.0 / open_points);
            }
        }
        const TimedBatch batch(costs, works);
        const auto techniques_of = [](const std::vector<AnyQuery>& asked) {
            std::vector<Technique> techniques;
            std::transform(asked.begin(), asked.end(), std::back_inserter(techniques),
                           technique_of);
            return techniques;
        };
        const double chosen = batch.time(techniques_of(choose(costs, queries)));
        const double least = batch.least(techniques_of(queries));
        exact += chosen <= least * preference ? 1 : 0;
        EXPECT_LE(chosen, (least + batch.largest()) * preference);
        const auto others = std::count_if(
            queries.begin(), queries.end(),
            [](const AnyQuery& query) { return technique_of(query) != Technique::automatic; });
        if (others > 0) {
            continue;
        }
        if (queries.size() == 1) {
            EXPECT_LE(chosen, least * preference);
        }
        for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
            EXPECT_LE(chosen,
                      batch.time(std::vector<Technique>(queries.size(), technique)) * (1.0 + 1e-12))
                << to_string(technique);
        }
    }
    EXPECT_GT(exact, cases * 9 / 10);
}

/// More queries than all ways to choose could be tried for: against a bound from below, which holds
/// for any price of the device's time.
TEST_F(ChooserTest, OfManyQueriesAsFew) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const CostModel costs = random_model(random);
        std::vector<AnyQuery> queries;
        std::vector<Work> works;
        for (int i = 0; i < 200; ++i) {
            queries.emplace_back(field(random.scale(1e-2, 0.5)));
            works.push_back(select::work_of(queries.back(), nullptr, large_));
        }
        const TimedBatch batch(costs, works);
        std::vector<Technique> techniques;
        for (const AnyQuery& query : choose(costs, queries)) {
            techniques.push_back(technique_of(query));
        }
        double bound = 0.0;
        for (int step = 0; step <= 100; ++step) {
            const double device = 1.0 - costs.overlap * 0.01 * step;
            const double cpu = 1.0 - costs.overlap * (1.0 - 0.01 * step);
            double sum = 0.0;
            for (const Work& work : works) {
                double least = work.time(costs.cpu.plan) + cpu * work.time(costs.cpu.answer);
                for (const DeviceCosts& by : {costs.raster, costs.compute}) {
                    least = std::min(least, work.time(by.plan) + work.time(by.read) +
                                                device * work.time(by.device));
                }
                sum += least;
            }
            bound = std::max(bound, sum);
        }
        double once = 0.0;  // the bound is for free submissions
        for (const DeviceCosts& by : {costs.raster, costs.compute}) {
            once += by.submission + by.latency;
        }
        EXPECT_LE(batch.time(techniques), (bound + once + batch.largest()) * preference);
    }
}

}  // namespace
}  // namespace nearfield::select
