#include <tests/query/agreement.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t point_summaries_seed = 52000;

/// Penetration by compute without records: most pairs have a row in place of the points found.
/// The answers are held to those with records, which are held to the oracle.
class PointSummaries : public QueryTest {
protected:
    static std::vector<double> numbers_of(PenetrationResult result) {
        result.points.clear();
        Results results;
        results.results.emplace_back(std::move(result));
        return all_numbers(results);
    }

    /// Many queries of all pairs in one batch, in which those with records, and contacts, lie
    /// between those without.
    static void check(const std::vector<Pair>& pairs) {
        std::vector<std::unique_ptr<PlacedPair>> placed;
        Batch with_records;
        Batch mixed;
        std::vector<QueryHandle<PenetrationQuery>> records;
        std::vector<QueryHandle<PenetrationQuery>> summaries;
        for (const Pair& pair : pairs) {
            const PlacedPair& one = *placed.emplace_back(
                std::make_unique<PlacedPair>(context(), pair, Technique::compute));
            for (const PenetrationPoints points : all_points) {
                PenetrationQuery query = one.penetration(points);
                records.push_back(with_records.add(query));
                query.summary_only = true;
                summaries.push_back(mixed.add(query));
            }
            if (placed.size() % 3 == 0) {
                mixed.add(one.contacts(2.0 * one.tolerance()));
            } else if (placed.size() % 3 == 1) {
                mixed.add(one.penetration());
            }
        }
        Results found;
        Results expected;
        ASSERT_TRUE(context().run(mixed, found).ok());
        ASSERT_TRUE(context().run(with_records, expected).ok());
        for (std::size_t i = 0; i < records.size(); ++i) {
            SCOPED_TRACE(describe(pairs[i / 2]));
            check(*placed[i / 2], all_points[i % 2], found[summaries[i]], expected[records[i]]);
        }
    }

    static void check(const PlacedPair& pair, PenetrationPoints points,
                      const PenetrationResult& found, const PenetrationResult& expected) {
        check_penetration(pair, points, expected);
        EXPECT_EQ(numbers_of(found), numbers_of(expected));
        PenetrationQuery query = pair.penetration(points);
        query.technique = Technique::cpu;
        query.summary_only = true;
        PenetrationResult by_cpu = run_alone(context(), query);
        by_cpu.technique = found.technique;
        by_cpu.regions = found.regions;
        check_agreement({pair, query}, found, by_cpu);
    }

    static Rings turned(Rings rings, double angle) {
        for (Ring& ring : rings) {
            for (Vector2& vertex : ring) {
                vertex = {vertex.x * std::cos(angle) - vertex.y * std::sin(angle),
                          vertex.x * std::sin(angle) + vertex.y * std::cos(angle)};
            }
        }
        return rings;
    }

    static constexpr std::array<PenetrationPoints, 2> all_points{PenetrationPoints::boundary,
                                                                 PenetrationPoints::vertices};
};

TEST_F(PointSummaries, HoldForRandomPairs) {
    for_each_case(point_summaries_seed, 4, [&](Random& random) {
        std::vector<Pair> pairs;
        for (int i = 0; i < 24; ++i) {
            pairs.push_back(any_pair(random));
        }
        check(pairs);
    });
}

// Points that are equally deep, as far as single precision can tell, or not; on the boundary; all
// of them inside, none, or one.
TEST_F(PointSummaries, HoldForDegeneratePairs) {
    const Rings square = rectangle({-1.0, -1.0}, {1.0, 1.0});
    const Rings small = rectangle({-0.4, -0.4}, {0.4, 0.4});
    const Rings large = rectangle({-3.0, -2.0}, {3.0, 2.0});
    const Rings touching = rectangle({1.0, -0.5}, {2.0, 0.5});
    const Rings tip = {{{0.9, 0.0}, {3.0, -0.1}, {3.0, 0.1}}};
    const std::vector<std::pair<Rings, Rings>> shapes{
        {square, square}, {small, square},    {square, small}, {large, square},
        {square, large},  {touching, square}, {square, tip},   {tip, square}};
    for_each_case(point_summaries_seed + 1000, 3, [&](Random& random) {
        std::vector<Pair> pairs;
        for (const auto& [a, b] : shapes) {
            // Moved by nothing, by less than a touch, by what single precision rounds.
            for (const double move : {0.0, 1e-9, 3e-7, 1e-5, 1e-3}) {
                Pair pair;
                // A's own frame is turned, so that the device rounds where its points are.
                const double turn = random.between(-3.0, 3.0);
                pair.a = {"A", turned(a, turn)};
                pair.b = {"B", b};
                const double angle = random.whole(0, 1) == 0 ? 0.0 : random.between(-3.0, 3.0);
                const double way = random.between(-3.0, 3.0);
                pair.pose_b = {{0.5, 0.25}, angle};
                pair.pose_a = {{0.5 + move * std::cos(way), 0.25 + move * std::sin(way)},
                               angle - turn};
                pair.tolerance = random.scale(0.005, 0.2);
                pairs.push_back(pair);
            }
        }
        check(pairs);
    });
}

// In a workgroup are points of directions that lie a multiple of its threads apart, as those
// between have no points.
TEST_F(PointSummaries, HoldForPairsOfWhichFewHavePoints) {
    Random random(point_summaries_seed + 2000);
    const Pair around{{"frame", rectangle({-9.0, -9.0}, {9.0, 9.0})},
                      {"square", rectangle({-1.0, -1.0}, {1.0, 1.0})},
                      {},
                      {},
                      0.3};
    const PlacedPair nothing(context(), around, Technique::compute);
    std::vector<std::unique_ptr<PlacedPair>> placed;
    std::vector<QueryHandle<PenetrationQuery>> handles;
    Batch batch;
    for (int i = 0; i < 30; ++i) {
        Pair pair = around;
        pair.a = {"star", star(random, 7, 0.4)};
        pair.pose_a.translation = {random.between(0.0, 1.3), 0.1};
        placed.push_back(std::make_unique<PlacedPair>(context(), pair, Technique::compute));
        PenetrationQuery query = placed.back()->penetration();
        query.summary_only = true;
        handles.push_back(batch.add(query));
        query = nothing.penetration();
        query.summary_only = true;
        for (int between = 1; between < 64; ++between) {
            batch.add(query);
        }
    }
    Results found;
    ASSERT_TRUE(context().run(batch, found).ok());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_GT(found[handles[i]].count, 0U);
        check(*placed[i], PenetrationPoints::boundary, found[handles[i]],
              run_alone(context(), placed[i]->penetration()));
    }
}

// More than a row counts: the CPU makes all of them exact.
TEST_F(PointSummaries, CountPointsByTheHundredThousand) {
    Random random(point_summaries_seed + 3000);
    Pair pair;
    pair.a = {"coast", coast(random, 500, 0.4)};
    pair.b = {"square", rectangle({-0.7, -2.0}, {2.0, 2.0})};
    pair.tolerance = 3e-5;
    const PlacedPair placed(context(), pair, Technique::compute);
    PenetrationQuery query = placed.penetration();
    query.summary_only = true;
    const PenetrationResult found = run_alone(context(), query);
    query.technique = Technique::cpu;
    const PenetrationResult expected = run_alone(context(), query);
    EXPECT_GT(found.count, 100'000U);
    EXPECT_EQ(found.count, expected.count);
    EXPECT_NEAR(found.deepest.depth, expected.deepest.depth, 1e-3 * pair.tolerance);
}

}  // namespace
}  // namespace nearfield::test
