#include <tests/query/all_numbers.hpp>
#include <tests/query/frames.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::test {
namespace {

TEST_F(Frames, AreCollectedInAnyOrderAndAnsweredAsByRun) {
    make(3);
    std::vector<std::vector<double>> expected;
    for (int i = 0; i < 3; ++i) {
        expected.push_back(run(batch(i)));
        ASSERT_GT(expected.back().size(), 500U);
    }
    ASSERT_NE(expected[0], expected[1]);
    for (const std::vector<int>& order :
         {std::vector{0, 1, 2}, std::vector{2, 1, 0}, std::vector{1, 2, 0}}) {
        std::vector<Ticket> tickets;
        for (int i = 0; i < 3; ++i) {
            tickets.push_back(submit(batch(i)));
        }
        for (const int i : order) {
            EXPECT_EQ(collect(tickets[static_cast<std::size_t>(i)]),
                      expected[static_cast<std::size_t>(i)])
                << "frame " << i;
        }
    }
}

TEST_F(Frames, BecomeReadyWithoutAnyWait) {
    make(1);
    const Ticket ticket = submit(batch(0));
    while (!counted().is_ready(ticket)) {
    }
    EXPECT_EQ(calls.waits, 0);
    EXPECT_TRUE(counted().is_ready(ticket));
    Results results;
    ASSERT_TRUE(counted().collect(ticket, results).ok());
    EXPECT_GT(results.timings.device, 0.0);
    EXPECT_GT(results.timings.total, 0.0);
}

TEST_F(Frames, AreNoMoreThanTheRingHolds) {
    for (const std::uint32_t frames : {1U, 3U, 8U}) {
        SCOPED_TRACE(frames);
        make(frames);
        Batch small;
        small.add(drawn(IntersectionQuery{{a_, {}}, {b_, {}}, 0.2}));
        std::vector<Ticket> tickets;
        for (std::uint32_t i = 0; i < frames; ++i) {
            tickets.push_back(submit(small));
        }
        EXPECT_EQ(counted().submit(small).error().code(), StatusCode::ring_full);
        Results results;
        EXPECT_EQ(counted().run(small, results).code(), StatusCode::ring_full);
        EXPECT_EQ(calls.submissions, static_cast<int>(frames));
        EXPECT_EQ(calls.waits, 0);
        const std::vector<double> numbers = collect(tickets.back());
        tickets.back() = submit(small);
        for (const Ticket ticket : tickets) {
            EXPECT_EQ(collect(ticket), numbers);
        }
    }
    for (const std::uint32_t frames : {0U, 9U}) {
        Settings settings;
        settings.batches_in_flight = frames;
        const Expected<Context> made = Context::create(host_device(), on_demand(settings));
        ASSERT_FALSE(made.has_value());
        EXPECT_EQ(made.error().code(), StatusCode::invalid_settings);
        EXPECT_NE(made.error().message().find("batches_in_flight is " + std::to_string(frames)),
                  std::string::npos);
        EXPECT_EQ(Context::create_headless({}, settings).error().code(),
                  StatusCode::invalid_settings);
    }
}

TEST_F(Frames, AreCollectedOnce) {
    make(2);
    const Ticket ticket = submit(batch(0));
    Results results;
    EXPECT_EQ(counted().collect({}, results).code(), StatusCode::unknown_ticket);
    EXPECT_EQ(counted().collect({ticket.number + 1}, results).code(), StatusCode::unknown_ticket);
    EXPECT_TRUE(counted().is_ready({}));
    ASSERT_TRUE(counted().collect(ticket, results).ok());
    const Status again = counted().collect(ticket, results);
    EXPECT_EQ(again.code(), StatusCode::unknown_ticket);
    EXPECT_NE(again.message().find(std::to_string(ticket.number)), std::string::npos);
    EXPECT_TRUE(counted().is_ready(ticket));
}

TEST_F(Frames, ThatAreRefusedLeaveNothing) {
    Settings settings;
    settings.batches_in_flight = 1;
    settings.memory_limit = 16U << 20U;
    make(settings);
    DistanceFieldQuery field;
    field.technique = Technique::raster;
    field.b = {b_, {}};
    field.tolerance = 1e-4;
    field.rectangle = Rectangle{{-1, -1}, {1, 1}};
    Batch too_large;
    too_large.add(field);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(counted().submit(too_large).error().code(), StatusCode::too_large);
    }
    EXPECT_EQ(collect(submit(batch(0))), run(batch(0)));
}

TEST_F(Frames, AnswerForShapesAsTheyWereSubmitted) {
    make(2);
    const std::vector<double> before[] = {run(batch(0)), run(batch(1))};
    const Rings other = scaled_and_moved(rings_a_, 0.8, {0.05, 0.0});
    const auto update = [&](const Rings& rings) {
        const Status status = counted().update_shape(a_, rings);
        EXPECT_TRUE(status.ok()) << status.text();
    };
    update(rings_b_);
    const std::vector<double> with_b = run(batch(1));
    ASSERT_NE(with_b, before[1]);
    update(rings_a_);
    for (int i = 0; i < 4; ++i) {
        const Ticket first = submit(batch(0));
        update(other);
        update(rings_b_);
        const Ticket second = submit(batch(1));
        if (i % 2 == 0) {  // while the shape is another one, and after it is the same again
            EXPECT_EQ(collect(first), before[0]);
        }
        update(rings_a_);
        EXPECT_EQ(counted().update_shape(a_, Rings{{{0, 0}, {1, 1}}}).code(),
                  StatusCode::invalid_shape);
        if (i % 2 == 1) {
            EXPECT_EQ(collect(first), before[0]);
        }
        EXPECT_EQ(collect(second), with_b);
        EXPECT_EQ(run(batch(1)), before[1]);
    }
    // Removed while in flight, and its slot is reused by another shape.
    const Ticket ticket = submit(batch(0));
    const Batch stale = batch(0);
    ASSERT_TRUE(counted().remove_shape(a_).ok());
    const Expected<ShapeHandle> next = counted().add_shape(other);
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(next->index, a_.index);
    EXPECT_EQ(collect(ticket), before[0]);
    Results results;
    ASSERT_TRUE(counted().run(stale, results).ok());
    EXPECT_NE(all_numbers(results), before[0]);
    a_ = *next;
    ASSERT_TRUE(counted().update_shape(a_, rings_a_).ok());
    EXPECT_EQ(run(batch(0)), before[0]);
}

TEST_F(Frames, BorrowNothing) {
    make(2);
    Batch queries = batch(0);
    for (const Technique technique : every_technique) {
        DistanceFieldQuery field;
        field.technique = technique;
        field.b = {b_, {}};
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        field.points = field_points_;
        queries.add(field);
    }
    const std::vector<double> expected = run(queries);
    const Ticket ticket = submit(queries);
    std::fill(field_points_.begin(), field_points_.end(), Vector2{1e9, 1e9});
    // Queries of other kinds in place of those of the batch.
    const std::size_t count = queries.queries().size();
    queries.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 2 == 0) {
            queries.add(DistanceFieldQuery{});
        } else {
            queries.add(IntersectionQuery{});
        }
    }
    EXPECT_EQ(collect(ticket), expected);
}

TEST_F(Frames, OfTwoContextsDoNotMeet) {
    make(2);
    Settings settings;
    settings.batches_in_flight = 1;
    Expected<Context> second = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(second.has_value()) << second.error().text();
    const Expected<ShapeHandle> a = second->add_shape(rings_a_);
    const Expected<ShapeHandle> b = second->add_shape(rings_b_);
    ASSERT_TRUE(a.has_value() && b.has_value());
    const std::vector<double> expected = run(batch(0));
    const Ticket here = submit(batch(0));
    a_ = *a;
    b_ = *b;
    const Expected<Ticket> there = second->submit(batch(0));
    ASSERT_TRUE(there.has_value()) << there.error().text();
    Results results;
    EXPECT_EQ(collect(here), expected);
    ASSERT_TRUE(second->collect(*there, results).ok());
    EXPECT_EQ(all_numbers(results), expected);
}

TEST_F(Frames, AreWaitedForWhenTheContextGoes) {
    make(2);
    (void)submit(batch(0));
    (void)submit(batch(1));
    EXPECT_EQ(calls.waits, 0);
    destroy();
    EXPECT_EQ(calls.waits, 2);
}

TEST_F(Frames, OfALostDeviceAllSaySo) {
    make(3);
    const Ticket tickets[] = {submit(batch(0)), submit(batch(1)), submit(batch(2))};
    calls.lose_device = true;
    Results results;
    const Status first = counted().collect(tickets[1], results);
    EXPECT_EQ(first.code(), StatusCode::device_lost);
    EXPECT_NE(first.message().find("vkWaitForFences"), std::string::npos) << first.message();
    EXPECT_TRUE(counted().is_ready(tickets[0]));
    EXPECT_EQ(counted().on_device(tickets[0], QueryHandle<DistanceFieldQuery>{0}).error().code(),
              StatusCode::device_lost);
    EXPECT_EQ(counted().collect(tickets[0], results).code(), StatusCode::device_lost);
    EXPECT_EQ(counted().collect(tickets[2], results).code(), StatusCode::device_lost);
    EXPECT_EQ(counted().collect(tickets[2], results).code(), StatusCode::unknown_ticket);
    EXPECT_EQ(counted().submit(batch(0)).error().code(), StatusCode::device_lost);
    EXPECT_EQ(counted().run(batch(0), results).code(), StatusCode::device_lost);
    destroy();
}

}  // namespace
}  // namespace nearfield::test
