#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 6000;

// What the library asks of the queue, counted on the way there.

struct Calls {
    int submissions = 0;
    int waits = 0;
    int render_passes = 0;
    bool lose_device = false;  ///< waiting says so, after it has waited
};
Calls calls;

template <class Function>
Function true_function(const char* name) {
    return reinterpret_cast<Function>(test_support::true_device_function(name));
}

VkResult VKAPI_CALL counted_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                   VkFence fence) {
    ++calls.submissions;
    return true_function<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VkResult VKAPI_CALL counted_wait(VkDevice device, std::uint32_t count, const VkFence* fences,
                                 VkBool32 all, std::uint64_t timeout) {
    ++calls.waits;
    const VkResult result =
        true_function<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
    return calls.lose_device ? VK_ERROR_DEVICE_LOST : result;
}

void VKAPI_CALL counted_render_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                    VkSubpassContents contents) {
    ++calls.render_passes;
    true_function<PFN_vkCmdBeginRenderPass>("vkCmdBeginRenderPass")(commands, info, contents);
}

test_support::Lies counting() {
    test_support::Lies lies;
    lies.entry_points["vkQueueSubmit"] = reinterpret_cast<PFN_vkVoidFunction>(&counted_submit);
    lies.entry_points["vkWaitForFences"] = reinterpret_cast<PFN_vkVoidFunction>(&counted_wait);
    lies.entry_points["vkCmdBeginRenderPass"] =
        reinterpret_cast<PFN_vkVoidFunction>(&counted_render_pass);
    return lies;
}

class Frames : public QueryTest {
protected:
    /// A context whose calls are counted, with two shapes.
    void make(const Settings& settings) {
        watched_.reset();
        loader_.reset();
        loader_ = std::make_unique<test_support::FakeLoader>(host_device(), counting());
        Expected<Context> made = Context::create(loader_->host(), drawing(settings));
        ASSERT_TRUE(made.ok()) << made.status().text();
        watched_ = std::make_unique<Context>(std::move(*made));
        Random random(seed);
        rings_a_ = coast(random, 120, 0.5);
        rings_b_ = with_holes(random, 3);
        const Expected<ShapeHandle> a = watched_->add_shape(rings_a_);
        const Expected<ShapeHandle> b = watched_->add_shape(rings_b_);
        ASSERT_TRUE(a.ok() && b.ok());
        a_ = *a;
        b_ = *b;
        calls = {};
    }
    void make(std::uint32_t frames) {
        Settings settings;
        settings.frames_in_flight = frames;
        make(settings);
    }
    void TearDown() override {
        watched_.reset();
        loader_.reset();
        QueryTest::TearDown();
    }

    [[nodiscard]] Context& watched() { return *watched_; }
    void destroy() { watched_.reset(); }

    /// One of each kind of query; `number` tells batches apart.
    [[nodiscard]] Batch batch(int number) const {
        const Instance here{a_, {}};
        const Instance there{b_, {{0.7, 0.1 * number}, 0.3}};
        const Instance apart{b_, {{3.0, 0.1 * number}, 0.3}};
        Batch batch;
        for (const Technique technique : {Technique::raster, Technique::cpu}) {
            batch.add(PenetrationQuery{here, there, 0.04, {}, true, technique});
            batch.add(ContactQuery{here, there, 0.04, 0.05, {}, true, technique});
            batch.add(SeparationQuery{here, apart, 0.04, technique});
            batch.add(ClosestPointQuery{here, apart, 0.04, technique});
        }
        batch.add(IntersectionQuery{here, there, 0.04});
        batch.add(IntersectionQuery{here, there, 0.04, IntersectionKind::boundary_volume});
        batch.add(ContactQuery{here, there, 0.04, 0.05, ContactNormals::gradient});
        DistanceFieldQuery field;
        field.b = there;
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        field.features = true;
        field.points = field_points_;
        batch.add(field);
        return batch;
    }
    /// What run() says.
    [[nodiscard]] std::vector<double> run(const Batch& batch) {
        Results results;
        const Status status = watched().run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    }
    [[nodiscard]] std::vector<double> collect(Ticket ticket) {
        Results results;
        const Status status = watched().collect(ticket, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    }
    [[nodiscard]] Ticket submit(const Batch& batch) {
        const Expected<Ticket> ticket = watched().submit(batch);
        EXPECT_TRUE(ticket.ok()) << ticket.status().text();
        return ticket.ok() ? *ticket : Ticket{};
    }

    Rings rings_a_;
    Rings rings_b_;
    ShapeHandle a_;
    ShapeHandle b_;
    std::vector<Vector2> field_points_{{0.1, 0.2}, {-0.3, 0.4}};

private:
    std::unique_ptr<test_support::FakeLoader> loader_;
    std::unique_ptr<Context> watched_;
};

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

TEST_F(Frames, TakeOneSubmissionAndOneWaitEach) {
    make(2);
    Batch one = batch(0);
    Batch without_gradients;
    for (const AnyQuery& query : one.queries()) {
        const auto* const contacts = std::get_if<ContactQuery>(&query);
        if (contacts == nullptr || contacts->normals == ContactNormals::analytic) {
            std::visit([&](const auto& same) { without_gradients.add(same); }, query);
        }
    }
    const Ticket first = submit(without_gradients);
    const Ticket second = submit(without_gradients);
    EXPECT_EQ(calls.submissions, 2);
    EXPECT_EQ(calls.waits, 0);
    const std::vector<double> numbers = collect(second);
    EXPECT_EQ(calls.waits, 1);
    EXPECT_EQ(collect(first), numbers);
    EXPECT_EQ(run(without_gradients), numbers);
    EXPECT_EQ(calls.submissions, 3);
    EXPECT_EQ(calls.waits, 3);
    // Gradient normals are the documented exception.
    EXPECT_EQ(collect(submit(one)), run(one));
    EXPECT_EQ(calls.submissions, 7);
}

TEST_F(Frames, ThatNeedNoDeviceSubmitNothing) {
    make(2);
    Batch batch;
    batch.add(PenetrationQuery{{a_, {}},
                               {b_, {{0.7, 0.0}, 0.0}},
                               0.04,
                               PenetrationPoints::boundary,
                               true,
                               Technique::cpu});
    batch.add(SeparationQuery{{a_, {}}, {b_, {{3.0, 0.0}, 0.0}}, 0.04, Technique::cpu});
    const Ticket ticket = submit(batch);
    EXPECT_TRUE(watched().is_ready(ticket));
    EXPECT_GT(collect(ticket).size(), 20U);
    const Ticket empty = submit({});
    EXPECT_TRUE(watched().is_ready(empty));
    EXPECT_TRUE(collect(empty).empty());
    EXPECT_EQ(calls.submissions + calls.waits, 0);
}

TEST_F(Frames, BecomeReadyWithoutAnyWait) {
    make(1);
    const Ticket ticket = submit(batch(0));
    while (!watched().is_ready(ticket)) {
    }
    EXPECT_EQ(calls.waits, 0);
    EXPECT_TRUE(watched().is_ready(ticket));
    Results results;
    ASSERT_TRUE(watched().collect(ticket, results).ok());
    EXPECT_GT(results.timings.device, 0.0);
    EXPECT_GT(results.timings.total, 0.0);
}

TEST_F(Frames, AreNoMoreThanTheRingHolds) {
    for (const std::uint32_t frames : {1U, 3U, 8U}) {
        SCOPED_TRACE(frames);
        make(frames);
        Batch small;
        small.add(IntersectionQuery{{a_, {}}, {b_, {}}, 0.2});
        std::vector<Ticket> tickets;
        for (std::uint32_t i = 0; i < frames; ++i) {
            tickets.push_back(submit(small));
        }
        EXPECT_EQ(watched().submit(small).status().code(), StatusCode::ring_full);
        Results results;
        EXPECT_EQ(watched().run(small, results).code(), StatusCode::ring_full);
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
        settings.frames_in_flight = frames;
        const Expected<Context> made = Context::create(host_device(), drawing(settings));
        ASSERT_FALSE(made.ok());
        EXPECT_EQ(made.status().code(), StatusCode::invalid_settings);
        EXPECT_NE(made.status().message().find("frames_in_flight is " + std::to_string(frames)),
                  std::string::npos);
        EXPECT_EQ(Context::create_headless({}, settings).status().code(),
                  StatusCode::invalid_settings);
    }
}

TEST_F(Frames, AreCollectedOnce) {
    make(2);
    const Ticket ticket = submit(batch(0));
    Results results;
    EXPECT_EQ(watched().collect({}, results).code(), StatusCode::unknown_ticket);
    EXPECT_EQ(watched().collect({ticket.number + 1}, results).code(), StatusCode::unknown_ticket);
    EXPECT_TRUE(watched().is_ready({}));
    ASSERT_TRUE(watched().collect(ticket, results).ok());
    const Status again = watched().collect(ticket, results);
    EXPECT_EQ(again.code(), StatusCode::unknown_ticket);
    EXPECT_NE(again.message().find(std::to_string(ticket.number)), std::string::npos);
    EXPECT_TRUE(watched().is_ready(ticket));
}

TEST_F(Frames, ThatAreRefusedLeaveNothing) {
    Settings settings;
    settings.frames_in_flight = 1;
    settings.memory_limit = 16U << 20U;
    make(settings);
    DistanceFieldQuery field;
    field.b = {b_, {}};
    field.tolerance = 1e-4;
    field.rectangle = Rectangle{{-1, -1}, {1, 1}};
    Batch too_large;
    too_large.add(field);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(watched().submit(too_large).status().code(), StatusCode::too_large);
    }
    EXPECT_EQ(collect(submit(batch(0))), run(batch(0)));
}

TEST_F(Frames, AnswerForShapesAsTheyWereSubmitted) {
    make(2);
    const std::vector<double> before[] = {run(batch(0)), run(batch(1))};
    const Rings other = scaled_and_moved(rings_a_, 0.8, {0.05, 0.0});
    const auto update = [&](const Rings& rings) {
        const Status status = watched().update_shape(a_, rings);
        EXPECT_TRUE(status.ok()) << status.text();
    };
    for (int i = 0; i < 3; ++i) {
        const Ticket first = submit(batch(0));
        update(other);
        update(rings_b_);
        const Ticket second = submit(batch(1));
        update(rings_a_);
        EXPECT_EQ(watched().update_shape(a_, Rings{{{0, 0}, {1, 1}}}).code(),
                  StatusCode::invalid_shape);
        EXPECT_EQ(collect(first), before[0]);
        EXPECT_NE(collect(second), before[1]);
        EXPECT_EQ(run(batch(1)), before[1]);
    }
    // Removed while in flight, and the place taken by another shape.
    const Ticket ticket = submit(batch(0));
    const Batch stale = batch(0);
    ASSERT_TRUE(watched().remove_shape(a_).ok());
    const Expected<ShapeHandle> next = watched().add_shape(other);
    ASSERT_TRUE(next.ok());
    EXPECT_EQ(next->index, a_.index);
    EXPECT_EQ(collect(ticket), before[0]);
    EXPECT_NE(run(stale), before[0]);
    a_ = *next;
    ASSERT_TRUE(watched().update_shape(a_, rings_a_).ok());
    EXPECT_EQ(run(batch(0)), before[0]);
}

TEST_F(Frames, BorrowNothing) {
    make(2);
    Batch queries = batch(0);
    const std::vector<double> expected = run(queries);
    const Ticket ticket = submit(queries);
    std::fill(field_points_.begin(), field_points_.end(), Vector2{1e9, 1e9});
    // Queries of other kinds where those of the batch have been.
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

TEST_F(Frames, KeepImagesThatOthersOutgrow) {
    make(3);
    std::vector<Batch> batches(3);
    const double tolerances[] = {0.2, 0.004, 0.0015};  // each needs a larger atlas
    for (std::size_t i = 0; i < batches.size(); ++i) {
        IntersectionQuery query{{a_, {}}, {b_, {}}, tolerances[i]};
        query.records = false;
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
    Random random(seed);
    const Pair pair{
        {"A", star(random, 60, 0.4)}, {"B", with_holes(random, 4)}, {}, {{0.3, 0.1}, 0.2}, 0.003};
    const PlacedPair placed(watched(), pair);
    Batch batch;
    const auto penetration = batch.add(placed.penetration());
    IntersectionQuery watched_query = placed.intersection(IntersectionKind::volume_volume);
    watched_query.records = false;
    const auto intersection = batch.add(watched_query);
    DistanceFieldQuery query;
    query.b = placed.instance_b();
    query.tolerance = 0.003;
    query.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    const auto field = batch.add(query);

    calls = {};
    const Ticket ticket = submit(batch);
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_GE(calls.render_passes, 8) << "not several rounds";
    Results results;
    const Status status = watched().collect(ticket, results);
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_EQ(calls.waits, 1);
    check_penetration(placed, PenetrationPoints::boundary, results[penetration]);
    check_field(placed.b(), query.tolerance, results[field], 2000);
    const PlacedPair in_one_round(context(), pair);
    watched_query.a.shape = in_one_round.instance_a().shape;
    watched_query.b.shape = in_one_round.instance_b().shape;
    EXPECT_EQ(results[intersection].count, run_alone(context(), watched_query).count);
    EXPECT_GT(results[intersection].count, 10000U);
    EXPECT_EQ(run(batch), all_numbers(results));
}

TEST_F(Frames, WithMoreSamplesThanRoomRunAgainOnce) {
    Settings settings;
    settings.memory_limit = 16U << 20U;
    make(settings);
    Batch batch;
    batch.add(IntersectionQuery{{a_, {}}, {a_, {}}, 0.003});  // most of the box is in both
    batch.add(IntersectionQuery{{a_, {}}, {b_, {}}, 0.05});
    const Ticket first = submit(batch);
    const Ticket second = submit(batch);
    EXPECT_EQ(calls.submissions, 2);
    EXPECT_GE(calls.render_passes, 6) << "not several rounds";
    Results results;
    ASSERT_TRUE(watched().collect(second, results).ok());
    EXPECT_GT(std::get<IntersectionResult>(results.results[0]).count, 50000U);
    EXPECT_EQ(calls.submissions, 3) << "there was room";
    EXPECT_EQ(collect(first), all_numbers(results));
    EXPECT_EQ(calls.submissions, 4);
    // Now there is room for all.
    EXPECT_EQ(collect(submit(batch)), all_numbers(results));
    EXPECT_EQ(calls.submissions, 5);
    EXPECT_EQ(calls.waits, 5);
}

TEST_F(Frames, OfTenThousandPairsTakeOneSubmission) {
    make(2);
    constexpr int pairs = 10000;
    constexpr double d = 0.1;
    Random random(seed);
    std::vector<ShapeHandle> shapes;
    for (int i = 0; i < 30; ++i) {
        const Expected<ShapeHandle> shape = watched().add_shape(star(random, 9, 0.4));
        ASSERT_TRUE(shape.ok());
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
        query.records = false;
        query.technique = Technique::raster;
        batch.add(query);
        query.technique = Technique::cpu;
        exact.add(query);
    }
    const Ticket ticket = submit(batch);
    EXPECT_EQ(calls.submissions, 1);
    Results expected;
    ASSERT_TRUE(watched().run(exact, expected).ok());
    Results results;
    ASSERT_TRUE(watched().collect(ticket, results).ok());
    EXPECT_EQ(calls.submissions, 1);
    EXPECT_EQ(calls.waits, 1);
    int penetrating = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const auto& one = std::get<PenetrationResult>(results.results[i]);
        const auto& other = std::get<PenetrationResult>(expected.results[i]);
        ASSERT_TRUE(one.status.ok()) << i << ": " << one.status.text();
        ASSERT_EQ(one.intersects, other.intersects) << i;
        ASSERT_EQ(one.technique, Technique::raster);
        // Points that touch, to within d/1000, may count or not.
        ASSERT_NEAR(one.count > 0 ? one.deepest.depth : 0.0,
                    other.count > 0 ? other.deepest.depth : 0.0, d / 1000.0)
            << i;
        penetrating += one.count > 0 ? 1 : 0;
    }
    EXPECT_GT(penetrating, pairs / 2);
    EXPECT_LT(penetrating, pairs);
}

TEST_F(Frames, OfTwoContextsDoNotMeet) {
    make(2);
    Settings settings;
    settings.frames_in_flight = 1;
    Expected<Context> second = Context::create(host_device(), drawing(settings));
    ASSERT_TRUE(second.ok()) << second.status().text();
    ASSERT_TRUE(second->add_shape(rings_a_).ok() && second->add_shape(rings_b_).ok());
    const std::vector<double> expected = run(batch(0));
    // The handles of the first two shapes are the same in both.
    const Ticket here = submit(batch(0));
    const Expected<Ticket> there = second->submit(batch(0));
    ASSERT_TRUE(there.ok()) << there.status().text();
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
    const Status first = watched().collect(tickets[1], results);
    EXPECT_EQ(first.code(), StatusCode::device_lost);
    EXPECT_NE(first.message().find("vkWaitForFences"), std::string::npos) << first.message();
    EXPECT_TRUE(watched().is_ready(tickets[0]));
    EXPECT_EQ(watched().resident(tickets[0], QueryHandle<DistanceFieldQuery>{0}).status().code(),
              StatusCode::device_lost);
    EXPECT_EQ(watched().collect(tickets[0], results).code(), StatusCode::device_lost);
    EXPECT_EQ(watched().collect(tickets[2], results).code(), StatusCode::device_lost);
    EXPECT_EQ(watched().collect(tickets[2], results).code(), StatusCode::unknown_ticket);
    EXPECT_EQ(watched().submit(batch(0)).status().code(), StatusCode::device_lost);
    EXPECT_EQ(watched().run(batch(0), results).code(), StatusCode::device_lost);
    destroy();
}

}  // namespace
}  // namespace nearfield::test
