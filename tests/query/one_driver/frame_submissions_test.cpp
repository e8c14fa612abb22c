#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/frames.hpp>

#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t frame_submissions_seed = 6000;

TEST_F(Frames, TakeOneSubmissionAndOneWaitEach) {
    make(2);
    const Batch all = batch(0);
    const Ticket first = submit(all);
    const Ticket second = submit(all);
    EXPECT_EQ(calls.submissions, 2);
    EXPECT_EQ(calls.waits, 0);
    const std::vector<double> numbers = collect(second);
    EXPECT_EQ(calls.waits, 1);
    EXPECT_EQ(collect(first), numbers);
    EXPECT_EQ(run(all), numbers);
    EXPECT_EQ(calls.submissions, 3);
    EXPECT_EQ(calls.waits, 3);
}

TEST_F(Frames, ThatNeedNoDeviceSubmitNothing) {
    make(2);
    Batch batch;
    batch.add(PenetrationQuery{{a_, {}},
                               {b_, {{0.7, 0.0}, 0.0}},
                               0.04,
                               PenetrationPoints::boundary,
                               false,
                               Technique::cpu});
    batch.add(SeparationQuery{{a_, {}}, {b_, {{3.0, 0.0}, 0.0}}, 0.04, Technique::cpu});
    const Ticket ticket = submit(batch);
    EXPECT_TRUE(counted().is_ready(ticket));
    EXPECT_GT(collect(ticket).size(), 20U);
    const Ticket empty = submit({});
    EXPECT_TRUE(counted().is_ready(empty));
    EXPECT_TRUE(collect(empty).empty());
    EXPECT_EQ(calls.submissions + calls.waits, 0);
}

TEST_F(Frames, KeepImagesThatOthersOutgrow) {
    make(3);
    std::vector<Batch> batches(3);
    const double tolerances[] = {0.2, 0.004, 0.0015};  // each needs a larger atlas
    for (std::size_t i = 0; i < batches.size(); ++i) {
        IntersectionQuery query{{a_, {}}, {b_, {}}, tolerances[i]};
        query.technique = Technique::raster;
        query.summary_only = true;
        batches[i].add(query);
    }
    std::vector<Ticket> tickets;
    for (const Batch& batch : batches) {
        tickets.push_back(submit(batch));
    }
    for (std::size_t i = 0; i < batches.size(); ++i) {
        const std::vector<double> numbers = collect(tickets[i]);
        EXPECT_EQ(numbers, run(batches[i]));
    }
}

TEST_F(Frames, OfSeveralRoundsTakeOneSubmission) {
    Settings settings;
    settings.memory_limit = 16U << 20U;  // an atlas of 256 x 256 cells
    make(settings);
    Random random(frame_submissions_seed);
    const Pair pair{
        {"A", star(random, 60, 0.4)}, {"B", with_holes(random, 4)}, {}, {{0.3, 0.1}, 0.2}, 0.003};
    const PlacedPair placed(counted(), pair);
    Batch batch;
    const auto penetration = batch.add(placed.penetration());
    IntersectionQuery watched_query = placed.intersection(IntersectionKind::volume_volume);
    watched_query.summary_only = true;
    const auto intersection = batch.add(watched_query);
    DistanceFieldQuery query;
    query.technique = Technique::raster;
    query.b = placed.instance_b();
    query.tolerance = 0.003;
    query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    const auto field = batch.add(query);

    calls = {};
    const Ticket ticket = submit(batch);
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_GE(calls.render_passes, 8) << "not several tile batches";
    Results results;
    const Status status = counted().collect(ticket, results);
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_EQ(calls.waits, 1);
    check_penetration(placed, PenetrationPoints::boundary, results[penetration]);
    check_field(placed.b(), query.tolerance, results[field], 2000);
    EXPECT_GT(results[intersection].count, 10000U);
    EXPECT_EQ(run(batch), all_numbers(results));
    // A few samples at the edges differ.
    watched_query.technique = Technique::compute;
    const auto count = static_cast<double>(results[intersection].count);
    EXPECT_NEAR(count, static_cast<double>(run_alone(counted(), watched_query).count),
                1e-3 * count);
}

TEST_F(Frames, WithMoreSamplesThanRoomRunAgainOnce) {
    Settings settings;
    settings.memory_limit = 16U << 20U;
    make(settings);
    Batch batch;
    batch.add(drawn(IntersectionQuery{{a_, {}}, {a_, {}}, 0.0033}));  // most of the box is in both
    batch.add(drawn(IntersectionQuery{{a_, {}}, {b_, {}}, 0.05}));
    const Ticket first = submit(batch);
    const Ticket second = submit(batch);
    EXPECT_EQ(calls.submissions, 2);
    EXPECT_GE(calls.render_passes, 6) << "not several tile batches";
    Results results;
    ASSERT_TRUE(counted().collect(second, results).ok());
    EXPECT_GT(std::get<IntersectionResult>(results.results[0]).count, 50000U);
    EXPECT_EQ(calls.submissions, 3) << "there was room";
    EXPECT_EQ(collect(first), all_numbers(results));
    EXPECT_EQ(calls.submissions, 4);
    // Now the capacity suffices for all.
    EXPECT_EQ(collect(submit(batch)), all_numbers(results));
    EXPECT_EQ(calls.submissions, 5);
    EXPECT_EQ(calls.waits, 5);
}

TEST_F(Frames, OfTenThousandPairsTakeOneSubmission) {
    make(2);
    constexpr int pairs = 10000;
    constexpr double d = 0.1;
    Random random(frame_submissions_seed);
    std::vector<ShapeHandle> shapes;
    for (int i = 0; i < 30; ++i) {
        const Expected<ShapeHandle> shape = counted().add_shape(star(random, 9, 0.4));
        ASSERT_TRUE(shape.has_value());
        shapes.push_back(*shape);
    }
    Batch batch;
    Batch exact;
    for (int i = 0; i < pairs; ++i) {
        const Vector2 place{4.0 * (i % 100), 4.0 * (i / 100)};
        PenetrationQuery query;
        query.a = {shapes[static_cast<std::size_t>(random.whole(0, 29))], {place, 0.01 * i}};
        query.b = {shapes[static_cast<std::size_t>(random.whole(0, 29))],
                   {{place.x + random.between(0.9, 1.7), place.y}, 0.02 * i}};
        query.tolerance = d;
        query.summary_only = true;
        query.technique = Technique::raster;
        batch.add(query);
        query.technique = Technique::cpu;
        exact.add(query);
    }
    const Ticket ticket = submit(batch);
    EXPECT_EQ(calls.submissions, 1);
    Results expected;
    ASSERT_TRUE(counted().run(exact, expected).ok());
    Results results;
    ASSERT_TRUE(counted().collect(ticket, results).ok());
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_EQ(calls.waits, 1);
    int penetrating = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const auto& one = std::get<PenetrationResult>(results.results[i]);
        const auto& other = std::get<PenetrationResult>(expected.results[i]);
        ASSERT_TRUE(one.status.ok()) << i << ": " << one.status.text();
        ASSERT_EQ(one.intersects, other.intersects) << i;
        ASSERT_EQ(one.technique, Technique::raster);
        // Points that touch within d/1000 may or may not count.
        ASSERT_NEAR(one.count > 0 ? one.deepest.depth : 0.0,
                    other.count > 0 ? other.deepest.depth : 0.0, d / 1000.0)
            << i;
        penetrating += one.count > 0 ? 1 : 0;
    }
    EXPECT_GT(penetrating, pairs / 2);
    EXPECT_LT(penetrating, pairs);
}

}  // namespace
}  // namespace nearfield::test
