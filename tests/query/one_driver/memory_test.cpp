#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <tuple>
#include <vector>

namespace nearfield::test {
namespace {

/// The memory limit of a batch determines how the CPU finds the samples of boundaries: brute force
/// with all samples stored; the same after localisation, which leaves fewer; or planned one by one.
class MemoryLimit : public QueryTest {
protected:
    /// Tens of thousands of samples on each boundary.
    static Pair finely_sampled(Random& random) {
        return {{"A", star(random, 40, 0.5)},
                {"B", star(random, 30, 0.4)},
                {{0.1, 0.2}, 0.7},
                {{0.5, 0.4}, 0.3},
                1e-4};
    }

    static Context with_memory(std::uint64_t mebibytes) {
        Settings settings;
        settings.memory_limit = mebibytes << 20U;
        settings.pipelines_on_demand = true;
        Expected<Context> context = Context::create(host_device(), settings);
        EXPECT_TRUE(context.has_value()) << context.error().text();
        return std::move(*context);
    }

    /// Calls `check(context with little memory, pair in a context with much memory, pair in the
    /// small one)`.
    template <class Check>
    static void for_each_pair(std::uint64_t seed, const Check& check) {
        for (const std::uint64_t mebibytes : {12U, 28U}) {
            SCOPED_TRACE(mebibytes);
            Context little = with_memory(mebibytes);
            for_each_case(seed, 4, [&](Random& random) {
                const Pair pair = finely_sampled(random);
                check(little, PlacedPair(context(), pair, Technique::cpu),
                      PlacedPair(little, pair, Technique::cpu));
            });
        }
    }

    static void expect_other_ways(const ResultSummary& much, const ResultSummary& scarce) {
        ASSERT_TRUE(much.status.ok() && scarce.status.ok()) << scarce.status.text();
        EXPECT_EQ(much.localization.nodes_evaluated, 0U) << "was localised";
        EXPECT_GT(scarce.localization.nodes_evaluated, 0U) << "was not localised";
    }

    static void expect_same(std::vector<PenetratingPoint> one,
                            std::vector<PenetratingPoint> other) {
        ASSERT_EQ(one.size(), other.size());
        const auto key = [](const PenetratingPoint& record) {
            return std::tie(record.position.x, record.position.y, record.depth, record.nearest.x,
                            record.nearest.y, record.feature.index, record.unique);
        };
        expect_same(std::move(one), std::move(other), key);
    }

    static void expect_same(std::vector<ContactPoint> one, std::vector<ContactPoint> other) {
        ASSERT_EQ(one.size(), other.size());
        const auto key = [](const ContactPoint& record) {
            return std::tie(record.on, record.position.x, record.position.y, record.distance,
                            record.normal.x, record.normal.y, record.feature.index, record.inside,
                            record.unique);
        };
        expect_same(std::move(one), std::move(other), key);
    }

    static void expect_same_summary(const PenetrationResult& one, const PenetrationResult& other) {
        EXPECT_EQ(one.count, other.count);
        EXPECT_EQ(one.deepest.depth, other.deepest.depth);
        EXPECT_EQ(one.deepest.unique, other.deepest.unique);
        EXPECT_EQ(one.intersects, other.intersects);
    }

private:
    template <class Record, class Key>
    static void expect_same(std::vector<Record> one, std::vector<Record> other, const Key& key) {
        for (std::vector<Record>* const records : {&one, &other}) {
            std::sort(records->begin(), records->end(),
                      [&](const Record& i, const Record& j) { return key(i) < key(j); });
        }
        for (std::size_t i = 0; i < one.size(); ++i) {
            ASSERT_TRUE(key(one[i]) == key(other[i])) << "record " << i << " in order of places";
        }
    }
};

TEST_F(MemoryLimit, LeavesPenetrationAsItIs) {
    for_each_pair(271, [](Context& little, const PlacedPair& much, const PlacedPair& scarce) {
        const PenetrationResult result = run_alone(context(), much.penetration());
        const PenetrationResult other = run_alone(little, scarce.penetration());
        expect_other_ways(result, other);
        EXPECT_GT(result.count, 1000U);
        expect_same_summary(result, other);
        expect_same(result.points, other.points);

        PenetrationQuery summary = scarce.penetration();
        summary.summary_only = true;
        expect_same_summary(result, run_alone(little, summary));
    });
}

TEST_F(MemoryLimit, LeavesContactsAsTheyAre) {
    for_each_pair(577, [](Context& little, const PlacedPair& much, const PlacedPair& scarce) {
        const double near = 100.0 * much.tolerance();
        const ContactResult result = run_alone(context(), much.contacts(near));
        const ContactResult other = run_alone(little, scarce.contacts(near));
        expect_other_ways(result, other);
        EXPECT_GT(result.count, 500U);
        EXPECT_EQ(result.intersects, other.intersects);
        EXPECT_EQ(result.manifold.size(), other.manifold.size());
        expect_same(result.points, other.points);
    });
}

}  // namespace
}  // namespace nearfield::test
