#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <string>
#include <utility>

namespace nearfield::test {
namespace {

/// The memory limit of a batch and what is found: only that has to fit, not the samples of
/// boundaries.
class MemoryLimit : public QueryTest {
protected:
    /// Hundreds of thousands of samples on each boundary.
    static Pair finely_sampled(Random& random) {
        return {{"A", star(random, 40, 0.5)},
                {"B", star(random, 30, 0.4)},
                {{0.1, 0.2}, 0.7},
                {{0.5, 0.4}, 0.3},
                1e-5};
    }

    static Context with_memory(std::uint64_t mebibytes) {
        Settings settings;
        settings.memory_limit = mebibytes << 20U;
        settings.pipelines_on_demand = true;
        Expected<Context> context = Context::create(host_device(), settings);
        EXPECT_TRUE(context.has_value()) << context.error().text();
        return std::move(*context);
    }

    /// The status of a batch of one query.
    template <class Query>
    static Status run(Context& context, const Query& query, typename Query::Result& result) {
        Batch batch;
        const auto handle = batch.add(query);
        Results results;
        Status status = context.run(batch, results);
        if (status.ok()) {
            result = results[handle];
        }
        return status;
    }
};

/// Whoever finds them.
class MemoryLimitOfTechniques : public MemoryLimit,
                                public testing::WithParamInterface<Technique> {};

INSTANTIATE_TEST_SUITE_P(MemoryLimit, MemoryLimitOfTechniques,
                         testing::Values(Technique::cpu, Technique::compute),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

TEST_P(MemoryLimitOfTechniques, IsForThePointsThatPenetrateAndNotForSamples) {
    Context little = with_memory(12);
    for_each_case(271, 2, [&](Random& random) {
        const Pair pair = finely_sampled(random);
        const PlacedPair much(context(), pair, GetParam());
        const PlacedPair scarce(little, pair, GetParam());
        const PenetrationResult all = run_alone(context(), much.penetration());
        ASSERT_GT(all.count, 70'000U) << "more than one list";
        EXPECT_EQ(all.count, all.points.size());

        PenetrationResult result;
        const Status refused = run(little, scarce.penetration(), result);
        EXPECT_EQ(refused.code(), StatusCode::too_large) << refused.text();
        PenetrationQuery summary = scarce.penetration();
        summary.summary_only = true;
        const Status status = run(little, summary, result);
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(result.count, all.count);
        EXPECT_EQ(result.deepest.depth, all.deepest.depth);
        EXPECT_EQ(result.deepest.position, all.deepest.position);
        EXPECT_EQ(result.deepest.unique, all.deepest.unique);
    });
}

TEST_P(MemoryLimitOfTechniques, IsForContactsAndNotForSamples) {
    Context little = with_memory(12);
    for_each_case(577, 2, [&](Random& random) {
        const Pair pair = finely_sampled(random);
        const PlacedPair much(context(), pair, GetParam());
        const PlacedPair scarce(little, pair, GetParam());
        const double near = 10000.0 * much.tolerance();
        const ContactResult all = run_alone(context(), much.contacts(near));
        ContactResult result;
        const Status refused = run(little, scarce.contacts(near), result);
        EXPECT_EQ(refused.code(), StatusCode::too_large) << refused.text();
        const double nearer = 10.0 * much.tolerance();
        const Status status = run(little, scarce.contacts(nearer), result);
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_GT(result.count, 100U);
        EXPECT_LT(result.count, all.count);
        const ContactResult other = run_alone(context(), much.contacts(nearer));
        EXPECT_EQ(result.count, other.count);
        EXPECT_EQ(result.points.size(), other.points.size());
    });
}

TEST_F(MemoryLimit, IsThatOfAllQueriesOfABatch) {
    Context little = with_memory(12);
    Random random(5);
    Pair pair = finely_sampled(random);
    pair.tolerance = 1e-3;
    const PlacedPair placed(little, pair, Technique::cpu);
    Batch batch;
    Results results;
    std::size_t queries = 0;
    Status status;
    for (; status.ok() && queries < 1000; ++queries) {
        batch.add(placed.penetration());
        status = little.run(batch, results);
    }
    EXPECT_GT(queries, 3U);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.text();
    EXPECT_NE(status.message().find("together with the queries before it"), std::string::npos)
        << status.text();
}

}  // namespace
}  // namespace nearfield::test
