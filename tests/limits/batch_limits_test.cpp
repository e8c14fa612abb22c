#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/limits/cut.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/run_on_threads.hpp>
#include <tests/support/techniques.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

const ResultSummary& summary_of(const AnyResult& any) {
    return std::visit([](const auto& result) -> const ResultSummary& { return result; }, any);
}

std::vector<double> numbers_of(const AnyResult& result) {
    Results alone;
    alone.results.push_back(result);
    return all_numbers(alone);
}

bool is_empty(const AnyResult& any) {
    return std::visit(
        [](const auto& result) {
            if constexpr (requires { result.samples; }) {
                return result.samples.empty() && result.count == 0;
            } else if constexpr (requires { result.manifold; }) {
                return result.points.empty() && result.manifold.empty() && result.count == 0;
            } else if constexpr (requires { result.deepest; }) {
                return result.points.empty() && result.count == 0;
            } else if constexpr (requires { result.values; }) {
                return result.values.empty() && result.features.empty() && result.points.empty() &&
                       result.gradients.empty();
            } else {
                return true;
            }
        },
        any);
}

/// Nested pentagons: contacts and overlap tests of these take many steps.
Rings nested(int rings) {
    Rings all;
    for (int i = 0; i < rings; ++i) {
        Ring ring = regular(5).front();
        for (Vector2& vertex : ring) {
            const double scale = 1.0 - 0.9 * i / rings;
            vertex = {scale * vertex.x, scale * vertex.y};
        }
        all.push_back(std::move(ring));
    }
    return all;
}

/// A context with two shapes, and batches on them.
class Pair {
public:
    Pair(Expected<Context> made, const Rings& a, const Rings& b) {
        EXPECT_TRUE(made.has_value()) << made.error().text();
        context_.emplace(std::move(*made));
        a_ = *context_->add_shape(a);
        b_ = *context_->add_shape(b);
    }

    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] Instance a() const { return {a_, {}}; }
    [[nodiscard]] Instance b() const { return {b_, {{0.7, 0.1}, 0.3}}; }
    [[nodiscard]] Batch every() const { return every_query(a_, b_, 1); }

    [[nodiscard]] Results answer(const Batch& batch) {
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return results;
    }

    /// A vector that is longer than necessary still separates; a bound that is lower still bounds.
    void expect_valid(const SeparationVectorQuery& query, const SeparationVectorResult& cut,
                      const SeparationVectorResult& whole) {
        EXPECT_EQ(cut.intersects, whole.intersects);
        EXPECT_LE(cut.lower_bound, whole.length);
        EXPECT_GE(cut.length, whole.lower_bound);
        EXPECT_LE(cut.lower_bound, cut.length);
        Instance moved = query.a;
        moved.pose.translation.x += cut.vector.x;
        moved.pose.translation.y += cut.vector.y;
        const auto test = context_->answer(IntersectionTestQuery{moved, query.b});
        ASSERT_TRUE(test.has_value());
        EXPECT_FALSE(test->intersects);
    }

    /// The time is never late, and the interval that is left open contains the time of impact.
    static void expect_valid(const TimeOfImpactResult& cut, const TimeOfImpactResult& whole) {
        EXPECT_EQ(cut.state, ImpactState::bound_not_reached);
        EXPECT_LE(cut.time, whole.time + whole.time_error_bound);
        EXPECT_GE(cut.time + cut.time_error_bound, whole.time);
    }

    /// Each result is whole, or says that it was cut and is empty, or states a bound that holds.
    void expect_whole_or_cut(const Batch& batch, const Results& results, const Results& whole) {
        ASSERT_EQ(results.results.size(), whole.results.size());
        for (std::size_t i = 0; i < results.results.size(); ++i) {
            SCOPED_TRACE(i);
            const AnyResult& result = results.results[i];
            const Status& status = summary_of(result).status;
            if (!status.ok()) {
                EXPECT_EQ(status.code(), StatusCode::cancelled) << status.text();
                EXPECT_NE(status.message().find("Limits::cancel"), std::string::npos);
                EXPECT_TRUE(is_empty(result));
            } else if (numbers_of(result) == numbers_of(whole.results[i])) {
                continue;
            } else if (const auto* query =
                           std::get_if<SeparationVectorQuery>(&batch.queries()[i])) {
                expect_valid(*query, std::get<SeparationVectorResult>(result),
                             std::get<SeparationVectorResult>(whole.results[i]));
            } else if (std::holds_alternative<TimeOfImpactResult>(result)) {
                expect_valid(std::get<TimeOfImpactResult>(result),
                             std::get<TimeOfImpactResult>(whole.results[i]));
            } else {
                ADD_FAILURE() << "neither whole nor cut";
            }
        }
    }

    /// Cuts a batch at its checkpoints; after each cut the next batch is as if nothing had been.
    /// Returns how often.
    std::uint64_t cut_everywhere(const Batch& batch) {
        const Results whole = answer(batch);
        const std::vector<double> numbers = all_numbers(whole);
        return test::cut_everywhere(dense, [&](std::uint64_t n) {
            SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
            Cut cut(n);
            Results results;
            const Status status = context_->run(batch, results, cut.limits());
            EXPECT_TRUE(status.ok()) << status.text();
            expect_whole_or_cut(batch, results, whole);
            if (cut.has_cut()) {
                EXPECT_EQ(cut.seen(), n) << "the call goes on after it was cancelled";
            }
            EXPECT_EQ(all_numbers(answer(batch)), numbers);
            return cut.has_cut() && !testing::Test::HasFailure();
        });
    }

private:
    std::optional<Context> context_;
    ShapeHandle a_;
    ShapeHandle b_;
};

/// Makes no pipelines that a test does not need.
Expected<Context> headless() {
    Settings settings;
    settings.pipelines_on_demand = true;
    return Context::create_headless({}, settings);
}

Rings large_star(std::uint64_t seed) {
    Random random(seed);
    return star(random, 600, 0.6);
}

/// Each query alone, by each technique: planned, answered by the CPU or read back from the device.
TEST(BatchLimits, CutEveryQueryAtEveryStage) {
    Pair pair(headless(), large_star(1), large_star(2));
    const Batch every = pair.every();
    for (std::size_t i = 0; i < every.queries().size(); ++i) {
        SCOPED_TRACE("query " + std::to_string(i) + " of every_query()");
        Batch one;
        std::visit([&](const auto& query) { one.add(query); }, every.queries()[i]);
        // At least before it is planned, and before it is answered.
        EXPECT_GE(pair.cut_everywhere(one), 2U);
        if (HasFailure()) {
            return;
        }
    }
}

TEST(BatchLimits, CutABatchOfAllQueriesAnywhere) {
    Pair pair(headless(), large_star(3), large_star(4));
    EXPECT_GT(pair.cut_everywhere(pair.every()), 40U);
}

TEST(BatchLimits, CutEntangledShapesInsideEachStage) {
    Pair pair(headless(), nested(60), nested(60));
    const Instance at = pair.a();
    for (const Technique technique : every_technique) {
        SCOPED_TRACE(to_string(technique));
        Batch batch;
        batch.add(ContactQuery{
            at, {pair.b().shape, {}}, 0.02, 0.05, ContactNormals::analytic, false, technique});
        batch.add(PenetrationQuery{
            at, {pair.b().shape, {}}, 0.02, PenetrationPoints::boundary, false, technique});
        EXPECT_GT(pair.cut_everywhere(batch), 20U);
    }
    Batch batch;
    batch.add(SeparationVectorQuery{at, pair.b(), 1e-3, 200'000});
    batch.add(ContainmentQuery{at, {pair.b().shape, {}}});
    EXPECT_GT(pair.cut_everywhere(batch), 20U);
}

/// Cuts the only query of a batch at its checkpoints; returns how often `is_wider(result)` was
/// true.
template <class Query, class IsWider>
int wider_results(Pair& pair, const Query& query, const IsWider& is_wider) {
    Batch batch;
    const auto handle = batch.add(query);
    int wider = 0;
    cut_everywhere(100, [&](std::uint64_t n) {
        Cut cut(n);
        Results results;
        EXPECT_TRUE(pair.context().run(batch, results, cut.limits()).ok());
        wider += results[handle].status.ok() && is_wider(results[handle]) ? 1 : 0;
        return cut.has_cut();
    });
    return wider;
}

/// What was found so far is a result: CutEveryQueryAtEveryStage checks that its bounds hold.
TEST(BatchLimits, LeaveTheSeparationVectorAndTheTimeOfImpactWithWiderBounds) {
    Pair pair(Context::create_cpu(), large_star(5), large_star(6));
    const SeparationVectorQuery vector{pair.a(), pair.b(), 1e-3};
    const double bound = pair.context().answer(vector)->lower_bound;
    EXPECT_GT(
        wider_results(pair, vector, [&](const auto& result) { return result.lower_bound < bound; }),
        50);
    const Pose stays{{3.0, 0.4}, 0.0};
    const TimeOfImpactQuery impact{
        pair.a(), {pair.b().shape, stays}, {{5.0, 0.0}, 20.0}, stays, 1e-6};
    EXPECT_EQ(pair.context().answer(impact)->state, ImpactState::hit);
    EXPECT_GT(wider_results(pair, impact,
                            [](const auto& result) {
                                return result.state == ImpactState::bound_not_reached;
                            }),
              5);
}

TEST(BatchLimits, EndJobsOnAllThreads) {
    Settings settings;
    settings.jobs = {nullptr, 4, run_on_threads};
    Pair pair(Context::create_cpu(settings), large_star(7), large_star(8));
    Batch batch;
    for (int i = 0; i < 12; ++i) {
        const Instance b{pair.b().shape, {{0.1 * i, 0.0}, 0.1 * i}};
        batch.add(ContactQuery{pair.a(), b, 0.02, 0.05});
        batch.add(IntersectionTestQuery{pair.a(), b});
        batch.add(SeparationVectorQuery{pair.a(), b, 0.01, 100'000});
    }
    const Results whole = pair.answer(batch);
    // Planning alone has one for each query.
    const std::uint64_t planning = batch.queries().size();
    std::uint64_t last = 0;
    for (std::uint64_t n = 1;; n += n / 2 + 1) {
        SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
        Cut cut(n);
        Results results;
        ASSERT_TRUE(pair.context().run(batch, results, cut.limits()).ok());
        pair.expect_whole_or_cut(batch, results, whole);
        EXPECT_EQ(all_numbers(pair.answer(batch)), all_numbers(whole));
        ASSERT_FALSE(HasFailure());
        if (!cut.has_cut()) {
            break;
        }
        last = n;
    }
    EXPECT_GT(last, 10 * planning) << "no job was cut";
}

/// A batch in flight: the limits of submit() end the planning, those of collect() the reading.
TEST(BatchLimits, HoldForOneCallOfABatchInFlight) {
    Pair pair(headless(), large_star(9), large_star(10));
    const Batch batch = pair.every();
    const Results whole = pair.answer(batch);
    Results results;
    for (const std::uint64_t n : {1U, 5U, 40U, 400U}) {
        SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
        Cut at_submit(n);
        Expected<Ticket> ticket = pair.context().submit(batch, at_submit.limits());
        ASSERT_TRUE(ticket.has_value());
        ASSERT_TRUE(pair.context().collect(*ticket, results).ok());
        pair.expect_whole_or_cut(batch, results, whole);
        Cut at_collect(n);
        ticket = pair.context().submit(batch);
        ASSERT_TRUE(ticket.has_value());
        ASSERT_TRUE(pair.context().collect(*ticket, results, at_collect.limits()).ok());
        pair.expect_whole_or_cut(batch, results, whole);
        EXPECT_EQ(pair.context().collect(*ticket, results).code(), StatusCode::unknown_ticket);
    }
    // Both calls tell how far they are: of all queries, and of those of the device.
    const Cut at_submit(0);
    const Cut at_collect(0);
    const Expected<Ticket> ticket = pair.context().submit(batch, at_submit.limits());
    ASSERT_TRUE(ticket.has_value());
    ASSERT_TRUE(pair.context().collect(*ticket, results, at_collect.limits()).ok());
    EXPECT_EQ(at_submit.count(), batch.queries().size());
    EXPECT_GT(at_collect.count(), 2U);
    EXPECT_LT(at_collect.count(), at_submit.count());
    EXPECT_LE(at_collect.done(), at_collect.count());
    EXPECT_EQ(all_numbers(pair.answer(batch)), all_numbers(whole));
}

TEST(BatchLimits, ChangeNothingThatTheyDoNotEnd) {
    Pair pair(headless(), large_star(11), large_star(12));
    const Batch batch = pair.every();
    Cut none(0);
    Results results;
    ASSERT_TRUE(pair.context().run(batch, results, none.limits()).ok());
    EXPECT_EQ(all_numbers(results), all_numbers(pair.answer(batch)));
    // Contacts with gradient normals ask for fields of their own.
    EXPECT_GE(none.count(), batch.queries().size());
    EXPECT_GT(none.done(), 0U);
    EXPECT_LE(none.done(), none.count());
}

TEST(BatchLimits, OfNoTimeAnswerNothing) {
    Pair pair(headless(), large_star(13), large_star(14));
    const Batch batch = pair.every();
    Limits limits;
    limits.seconds = 0.0;
    Results results;
    ASSERT_TRUE(pair.context().run(batch, results, limits).ok());
    ASSERT_EQ(results.results.size(), batch.queries().size());
    for (const AnyResult& result : results.results) {
        const Status& status = summary_of(result).status;
        EXPECT_EQ(status.code(), StatusCode::budget_exhausted) << status.text();
        EXPECT_NE(status.message().find("0 s (Limits::seconds)"), std::string::npos);
        EXPECT_TRUE(is_empty(result));
    }
    const auto alone = pair.context().answer(IntersectionTestQuery{pair.a(), pair.b()}, limits);
    EXPECT_EQ(alone.error().code(), StatusCode::budget_exhausted);
}

TEST(BatchLimits, ThatAreNoneAreRefused) {
    Pair pair(Context::create_cpu(), large_star(15), large_star(16));
    Batch batch;
    batch.add(IntersectionTestQuery{pair.a(), pair.b()});
    Results results;
    for (const double seconds : {-1.0, std::nan("")}) {
        Limits limits;
        limits.seconds = seconds;
        const Status status = pair.context().run(batch, results, limits);
        EXPECT_EQ(status.code(), StatusCode::invalid_settings);
        EXPECT_NE(status.message().find("Limits::seconds"), std::string::npos) << status.text();
    }
    Limits limits;
    limits.seconds = std::numeric_limits<double>::max();
    EXPECT_TRUE(pair.context().run(batch, results, limits).ok());
    EXPECT_TRUE(summary_of(results.results.front()).status.ok());
}

}  // namespace
}  // namespace nearfield::test
