#include <tests/query/query_test.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

/// Tests of the time of each query (Batch::time_queries), in a context of their own.
class QueryTimes : public QueryTest {
protected:
    void SetUp() override { make({}); }
    void TearDown() override {
        made_.reset();
        QueryTest::TearDown();
    }

    void make(const Settings& settings) {
        Expected<Context> made = Context::create(host_device(), on_demand(settings));
        ASSERT_TRUE(made.has_value()) << made.error().text();
        made_.emplace(std::move(*made));
        Random random(9100);
        light_ = *made_->add_shape(regular(5));
        heavy_ = *made_->add_shape(coast(random, 3000, 0.5));
    }
    [[nodiscard]] Context& made() { return *made_; }

    [[nodiscard]] PenetrationQuery depths(ShapeHandle shape, Technique technique) const {
        PenetrationQuery query{{shape, {{0.2, 0.1}, 0.3}}, {shape, {}}, 0.01};
        query.technique = technique;
        return query;
    }
    [[nodiscard]] DistanceFieldQuery field(Technique technique) const {
        DistanceFieldQuery query;
        query.b = {light_, {}};
        query.tolerance = 0.02;
        query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        query.technique = technique;
        return query;
    }

    Results run(const Batch& batch) {
        Results results;
        const Status status = made().run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return results;
    }

    ShapeHandle light_;
    ShapeHandle heavy_;

private:
    std::optional<Context> made_;
};

double sum_of(const std::vector<QueryTime>& times, double QueryTime::*part) {
    return std::accumulate(times.begin(), times.end(), 0.0,
                           [part](double sum, const QueryTime& time) { return sum + time.*part; });
}

double sum_of(const std::vector<PassTime>& passes) {
    return std::accumulate(passes.begin(), passes.end(), 0.0, [](double sum, const PassTime& pass) {
        return sum + pass.milliseconds;
    });
}

TEST_F(QueryTimes, AreThereOnlyIfAskedFor) {
    Batch batch;
    batch.add(depths(light_, Technique::cpu));
    batch.add(field(Technique::compute));
    Results results = run(batch);
    EXPECT_TRUE(results.timings.queries.empty());
    batch.time_queries(true);
    ASSERT_TRUE(made().run(batch, results).ok());
    EXPECT_EQ(results.timings.queries.size(), 2U);
    batch.time_queries(false);
    ASSERT_TRUE(made().run(batch, results).ok());
    EXPECT_TRUE(results.timings.queries.empty());
}

TEST_F(QueryTimes, AreThoseOfTheirQueries) {
    Batch batch;
    batch.time_queries(true);
    constexpr std::size_t heavy = 3;
    for (std::size_t i = 0; i < 6; ++i) {
        batch.add(depths(i == heavy ? heavy_ : light_, Technique::cpu));
    }
    batch.add(field(Technique::cpu));
    batch.add(field(Technique::raster));
    batch.add(depths(heavy_, Technique::compute));
    constexpr std::size_t planned = 8;
    // The least of several frames: other programs may delay any of them.
    std::vector<QueryTime> least;
    for (int frame = 0; frame < 8; ++frame) {
        const Results results = run(batch);
        const Timings& timings = results.timings;
        ASSERT_EQ(timings.queries.size(), batch.queries().size());
        // Everything is answered in this thread, and what is shared belongs to no query.
        EXPECT_LE(sum_of(timings.queries, &QueryTime::plan), timings.localize + timings.plan);
        EXPECT_LE(sum_of(timings.queries, &QueryTime::answer), timings.decode);
        for (std::size_t i = 0; i < timings.queries.size(); ++i) {
            const QueryTime& time = timings.queries[i];
            EXPECT_GT(time.plan, 0.0) << i;
            EXPECT_GT(time.answer, 0.0) << i;
            if (i == least.size()) {
                least.push_back(time);
            }
            least[i].plan = std::min(least[i].plan, time.plan);
            least[i].answer = std::min(least[i].answer, time.answer);
        }
    }
    for (const std::size_t light : {0U, 1U, 2U, 4U, 5U}) {
        EXPECT_GT(least[heavy].answer, 5.0 * least[light].answer) << light;
    }
    EXPECT_GT(least[heavy].answer, least[heavy].plan);
    EXPECT_GT(least[planned].answer, least[0].answer);
}

TEST_F(QueryTimes, TheDeviceIsAttributedToAQueryThatHasItAlone) {
    ContactQuery contacts{{light_, {{0.2, 0.1}, 0.3}}, {light_, {}}, 0.01, 0.05};
    contacts.technique = Technique::compute;
    const std::vector<AnyQuery> all{field(Technique::raster), field(Technique::compute),
                                    depths(light_, Technique::raster),
                                    depths(light_, Technique::compute), contacts};
    for (std::size_t i = 0; i < all.size(); ++i) {
        Batch batch;
        batch.time_queries(true);
        batch.add(depths(light_, Technique::cpu));
        std::visit([&](const auto& query) { batch.add(query); }, all[i]);
        const Results alone = run(batch);
        const std::vector<QueryTime>& times = alone.timings.queries;
        EXPECT_FALSE(times[0].device.has_value()) << i;
        ASSERT_EQ(times[1].device.has_value(), !alone.timings.passes.empty()) << i;
        if (times[1].device) {
            EXPECT_GT(*times[1].device, 0.0) << i;
            EXPECT_DOUBLE_EQ(*times[1].device, sum_of(alone.timings.passes)) << i;
        }
        // With another one on the device, neither is.
        batch.add(field(Technique::raster));
        for (const QueryTime& time : run(batch).timings.queries) {
            EXPECT_FALSE(time.device.has_value()) << i;
        }
    }
}

TEST_F(QueryTimes, NothingIsInventedWithoutTimestamps) {
    Settings settings;
    settings.timestamps = false;
    make(settings);
    Batch batch;
    batch.time_queries(true);
    batch.add(field(Technique::raster));
    const Results results = run(batch);
    EXPECT_FALSE(results.timings.queries[0].device.has_value());
    EXPECT_GT(results.timings.queries[0].answer, 0.0);
}

TEST_F(QueryTimes, AreMeasuredInJobsToo) {
    Settings settings;
    settings.jobs.count = 4;
    settings.jobs.run = [](void* /*user*/, std::uint32_t jobs,
                           void (*job)(void* data, std::uint32_t number), void* data) {
        for (std::uint32_t number = jobs; number > 0; --number) {
            job(data, number - 1);
        }
    };
    make(settings);
    Batch batch;
    batch.time_queries(true);
    for (int i = 0; i < 40; ++i) {
        batch.add(depths(i % 4 == 0 ? heavy_ : light_, Technique::cpu));
    }
    const Results results = run(batch);
    ASSERT_EQ(results.timings.queries.size(), 40U);
    for (const QueryTime& time : results.timings.queries) {
        EXPECT_GT(time.plan, 0.0);
        EXPECT_GT(time.answer, 0.0);
    }
    EXPECT_LE(sum_of(results.timings.queries, &QueryTime::answer), results.timings.decode);
}

TEST_F(QueryTimes, OfARefusedQueryIsItsCheck) {
    Batch batch;
    batch.time_queries(true);
    PenetrationQuery bad = depths(light_, Technique::cpu);
    bad.tolerance = -1.0;
    batch.add(bad);
    ContactQuery gradients{{light_, {{0.2, 0.1}, 0.3}}, {light_, {}}, 0.01, 0.05};
    gradients.normals = ContactNormals::gradient;
    gradients.technique = Technique::raster;
    batch.add(gradients);
    const Results results = run(batch);
    EXPECT_FALSE(results[QueryHandle<PenetrationQuery>{0}].status.ok());
    EXPECT_GT(results.timings.queries[0].plan, 0.0);
    EXPECT_GT(results.timings.queries[1].answer, 0.0);
}

}  // namespace
}  // namespace nearfield::test
