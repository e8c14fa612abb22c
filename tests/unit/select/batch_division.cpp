#include "chooser_test.hpp"
#include "timed_batch.hpp"

#include <engine/select/work.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace nearfield::select {
namespace {

using test::Random;

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
    slow.compute.device.field.query = 600.0;
    EXPECT_EQ(on_device(slow), 2);  // 1,200 microseconds beside the CPU's 1,700, in place of 1,900
    slow.compute.device.field.query = 900.0;
    EXPECT_EQ(on_device(slow), 0);  // 1,800 are no reason to divide
    slow.compute.device.field.query = 600.0;
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

TEST_F(ChooserTest, DividesNoQueriesWhoseShapesBothSidesWouldPrepare) {
    CostModel costs;
    costs.raster.latency = 1e6;
    costs.cpu.answer.points = costs.compute.device.points = {.query = 100.0};
    costs.overlap = 1.0;
    const std::vector<AnyQuery> queries(10, penetration(0.1));
    const auto on_device = [&](double shapes) {
        costs.cpu.answer.points.shape = shapes / (small_.size() + large_.size());
        const std::vector<AnyQuery> chosen = choose(costs, queries);
        return std::count_if(chosen.begin(), chosen.end(), [](const AnyQuery& query) {
            return technique_of(query) == Technique::compute;
        });
    };
    EXPECT_EQ(on_device(0.0), 5);   // 500 microseconds on either side
    EXPECT_EQ(on_device(1e5), 10);  // 1,000 against 1e5 + 500
    costs.compute.plan.points.shape = 600.0 / (small_.size() + large_.size());
    EXPECT_EQ(on_device(0.0), 0);  // 1,000 against 600 + 500
    costs.compute.plan.points.shape = 300.0 / (small_.size() + large_.size());
    EXPECT_EQ(on_device(0.0), 5);  // 1,000 against 300 + 500
}

/// The CPU is chosen where the batch takes up to so much longer; and room for a 4,096th.
constexpr double preference = 1.0 / 0.9 + 1.0 / 4096.0;

TEST_F(ChooserTest, TakesTheLeastTimeButForOneQuery) {
    int exact = 0;  // but for the preference
    constexpr int cases = 400;
    for (std::uint64_t seed = 0; seed < cases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const CostModel costs = random_model(random);
        std::vector<AnyQuery> queries;
        std::vector<TimedQuery> timed;
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
            TimedQuery& last = timed.emplace_back();
            last.work = select::work_of(query, &small_, large_);
            if (technique_of(query) != Technique::automatic) {
                last.work.shape_edges = last.work.edges;
            } else if (std::holds_alternative<PenetrationQuery>(query)) {
                last.shapes = {0, 1};
            } else {
                last.shapes = {1};
            }
        }
        const TimedBatch batch(
            costs, timed, {static_cast<double>(small_.size()), static_cast<double>(large_.size())});
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
        std::vector<TimedQuery> timed;
        for (int i = 0; i < 200; ++i) {
            queries.emplace_back(field(random.scale(1e-2, 0.5)));
            timed.push_back({select::work_of(queries.back(), nullptr, large_), {0}});
        }
        const TimedBatch batch(costs, timed, {static_cast<double>(large_.size())});
        std::vector<Technique> techniques;
        for (const AnyQuery& query : choose(costs, queries)) {
            techniques.push_back(technique_of(query));
        }
        double bound = 0.0;
        for (int step = 0; step <= 100; ++step) {
            const double device = 1.0 - costs.overlap * 0.01 * step;
            const double cpu = 1.0 - costs.overlap * (1.0 - 0.01 * step);
            double sum = 0.0;
            for (const auto& [work, shapes] : timed) {
                double least = work.time(costs.cpu.plan) + cpu * work.time(costs.cpu.answer);
                for (const DeviceCosts& by : {costs.raster, costs.compute}) {
                    least = std::min(least, work.time(by.plan) + work.time(by.read) +
                                                device * work.time(by.device));
                }
                sum += least;
            }
            bound = std::max(bound, sum);
        }
        double once = 0.0;  // the bound is for free submissions and shapes
        for (const DeviceCosts& by : {costs.raster, costs.compute}) {
            once += by.submission + by.latency;
        }
        for (const QueryCosts& by :
             {costs.raster.plan, costs.raster.device, costs.raster.read, costs.compute.plan,
              costs.compute.device, costs.compute.read, costs.cpu.plan, costs.cpu.answer}) {
            once += by.field.shape * large_.size();
        }
        EXPECT_LE(batch.time(techniques), (bound + once + batch.largest()) * preference);
    }
}

}  // namespace
}  // namespace nearfield::select
