#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <tuple>
#include <vector>

namespace nearfield::test {
namespace {

/// How much memory a batch may need decides how the CPU finds the samples of boundaries: edge by
/// edge, keeping all at once, or planned after localisation.
class MemoryLimit : public QueryTest {
protected:
    /// Tens of thousands of samples on either boundary.
    static Pair finely_sampled(Random& random) {
        return {{"A", star(random, 40, 0.5)},
                {"B", star(random, 30, 0.4)},
                {{0.1, 0.2}, 0.7},
                {{0.5, 0.4}, 0.3},
                1e-4};
    }

    static Context with_little_memory() {
        Settings settings;
        settings.memory_limit = std::uint64_t{24} << 20U;
        Expected<Context> context = Context::create(host_device(), settings);
        EXPECT_TRUE(context.ok()) << context.status().text();
        return std::move(context.value());
    }

    static void expect_same(std::vector<PenetrationRecord> one,
                            std::vector<PenetrationRecord> other) {
        ASSERT_EQ(one.size(), other.size());
        const auto key = [](const PenetrationRecord& record) {
            return std::tie(record.point.x, record.point.y, record.depth, record.nearest.x,
                            record.nearest.y, record.feature.index, record.unique);
        };
        expect_same(std::move(one), std::move(other), key);
    }

    static void expect_same(std::vector<ContactRecord> one, std::vector<ContactRecord> other) {
        ASSERT_EQ(one.size(), other.size());
        const auto key = [](const ContactRecord& record) {
            return std::tie(record.on, record.point.x, record.point.y, record.distance,
                            record.normal.x, record.normal.y, record.feature.index, record.inside,
                            record.unique);
        };
        expect_same(std::move(one), std::move(other), key);
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
    Context little = with_little_memory();
    for_each_case(271, 4, [&](Random& random) {
        const Pair pair = finely_sampled(random);
        const PlacedPair at_once(context(), pair, Technique::cpu);
        const PlacedPair planned(little, pair, Technique::cpu);
        for (const bool records : {true, false}) {
            PenetrationQuery query = at_once.penetration();
            query.records = records;
            const PenetrationResult result = run_alone(context(), query);
            query = planned.penetration();
            query.records = records;
            const PenetrationResult other = run_alone(little, query);
            ASSERT_TRUE(result.status.ok() && other.status.ok()) << other.status.text();
            EXPECT_EQ(result.localization.nodes_evaluated, 0U) << "was planned";
            EXPECT_GT(other.localization.nodes_evaluated, 0U) << "was not planned";
            EXPECT_GT(result.count, 1000U);
            EXPECT_EQ(result.count, other.count);
            EXPECT_EQ(result.deepest.depth, other.deepest.depth);
            EXPECT_EQ(result.intersects, other.intersects);
            expect_same(result.records, other.records);
        }
    });
}

TEST_F(MemoryLimit, LeavesContactsAsTheyAre) {
    Context little = with_little_memory();
    for_each_case(577, 4, [&](Random& random) {
        const Pair pair = finely_sampled(random);
        const PlacedPair at_once(context(), pair, Technique::cpu);
        const PlacedPair planned(little, pair, Technique::cpu);
        const double near = 100.0 * pair.tolerance;
        const ContactResult result = run_alone(context(), at_once.contacts(near));
        const ContactResult other = run_alone(little, planned.contacts(near));
        ASSERT_TRUE(result.status.ok() && other.status.ok()) << other.status.text();
        EXPECT_EQ(result.localization.nodes_evaluated, 0U) << "was planned";
        EXPECT_GT(other.localization.nodes_evaluated, 0U) << "was not planned";
        EXPECT_GT(result.count, 500U);
        EXPECT_EQ(result.intersects, other.intersects);
        EXPECT_EQ(result.manifold.size(), other.manifold.size());
        expect_same(result.records, other.records);
    });
}

}  // namespace
}  // namespace nearfield::test
