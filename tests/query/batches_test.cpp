#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <type_traits>
#include <variant>

namespace nearfield::test {
namespace {

constexpr std::uint64_t batches_seed = 300;

class Batches : public QueryTest {
protected:
    /// All kinds of queries on a pair from every family.
    struct Everything {
        std::deque<PlacedPair> pairs;
        Batch batch;
    };
    static void fill(Everything& all) {
        for (Pair& pair : family_pairs(batches_seed)) {
            all.pairs.emplace_back(context(), std::move(pair));
            const PlacedPair& placed = all.pairs.back();
            all.batch.add(placed.penetration(PenetrationPoints::boundary));
            all.batch.add(placed.intersection(IntersectionKind::volume_volume));
            all.batch.add(placed.penetration(PenetrationPoints::vertices));
            all.batch.add(placed.intersection(IntersectionKind::boundary_boundary));
            DistanceFieldQuery field;
            field.technique = Technique::raster;
            field.b = placed.instance_b();
            field.tolerance = 0.3;
            field.rectangle = Rectangle{{-12, -12}, {12, 12}};
            all.batch.add(field);
            all.batch.add(placed.intersection(IntersectionKind::boundary_volume));
        }
    }
};

template <class Result>
std::vector<double> answer_of(Result result) {
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    Numbers numbers;
    numbers.add(result.intersects, result.error_bound, result.regions.size());
    if constexpr (requires { result.deepest; }) {
        // Any of several coincident edges may be named, and which one may depend on a tile's place
        // in the atlas. `nearest` is on each of them.
        result.deepest.feature.index = 0;
        for (PenetratingPoint& point : result.points) {
            point.feature.index = 0;
        }
    }
    if constexpr (requires { result.values; }) {
        numbers.add(result.origin, result.width, result.height, result.values);
    } else {
        numbers.add_answer(result);
    }
    return numbers.list();
}

/// Expects bitwise identical results.
void expect_same_answers(const AnyResult& a, const AnyResult& b) {
    ASSERT_EQ(a.index(), b.index());
    std::visit(
        [&]<class Result>(const Result& one) {
            EXPECT_EQ(answer_of(one), answer_of(std::get<Result>(b)));
        },
        a);
}

/// Expects equal results up to both bounds: how far a shape is simplified depends on the other
/// queries of the batch.
void expect_alike(const DistanceFieldResult& a, const DistanceFieldResult& b) {
    ASSERT_TRUE(a.status.ok() && b.status.ok());
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.width, b.width);
    ASSERT_EQ(a.values.size(), b.values.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        most = std::max(most, static_cast<double>(std::abs(a.values[i] - b.values[i])));
    }
    EXPECT_LE(most, a.error_bound + b.error_bound);
}

TEST_F(Batches, AnswerEachQueryAsIfAlone) {
    Everything all;
    fill(all);
    Results together;
    const Status status = context().run(all.batch, together);
    ASSERT_TRUE(status.ok()) << status.text();
    const auto queries = all.batch.queries();
    ASSERT_EQ(together.results.size(), queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        SCOPED_TRACE("query " + std::to_string(i) + '\n' + describe(all.pairs[i / 6].pair()));
        std::visit(
            [&](const auto& query) {
                const auto alone = run_alone(context(), query);
                if constexpr (std::is_same_v<decltype(alone), const DistanceFieldResult>) {
                    expect_alike(std::get<DistanceFieldResult>(together.results[i]), alone);
                } else {
                    expect_same_answers(together.results[i], alone);
                }
            },
            queries[i]);
    }
}

TEST_F(Batches, RunTwiceGiveTheSame) {
    Everything all;
    fill(all);
    Results first;
    Results second;
    ASSERT_TRUE(context().run(all.batch, first).ok());
    ASSERT_TRUE(context().run(all.batch, second).ok());
    // Reuses the result object: nothing of the first answer may remain.
    ASSERT_TRUE(context().run(all.batch, first).ok());
    ASSERT_EQ(first.results.size(), second.results.size());
    for (std::size_t i = 0; i < first.results.size() && !HasFailure(); ++i) {
        SCOPED_TRACE("query " + std::to_string(i));
        expect_same_answers(first.results[i], second.results[i]);
    }
    EXPECT_GT(second.timings.total, 0.0);
}

/// Neither results of other kinds nor refusals.
TEST_F(Batches, ShowNothingOfWhatResultsHeldBefore) {
    Random random(batches_seed);
    const ShapeHandle a = *context().add_shape(star(random, 20, 0.5));
    const ShapeHandle b = *context().add_shape(with_holes(random, 3));
    Results kept;
    for (int number = 0; number < 4; ++number) {
        SCOPED_TRACE(number);
        const Batch every = every_query(a, b, 0);
        const auto queries = every.queries();
        Batch batch;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            AnyQuery any = queries[(5 * static_cast<std::size_t>(number) + i) % queries.size()];
            std::visit(
                [&](auto& query) {
                    if (i % 3 == static_cast<std::size_t>(number) % 3) {
                        query.b.pose.angle = infinity;
                    }
                    batch.add(query);
                },
                any);
        }
        Results fresh;
        ASSERT_TRUE(context().run(batch, fresh).ok());
        ASSERT_TRUE(context().run(batch, kept).ok());
        EXPECT_EQ(all_numbers(kept), all_numbers(fresh));
    }
    EXPECT_TRUE(context().remove_shape(a).ok());
    EXPECT_TRUE(context().remove_shape(b).ok());
}

TEST_F(Batches, EmptyOnesAreFine) {
    Batch batch;
    Results results;
    EXPECT_TRUE(context().run(batch, results).ok());
    EXPECT_TRUE(results.results.empty());
    const PlacedPair pair(context(), family_pairs(batches_seed)[1]);
    const auto handle = batch.add(pair.penetration());
    ASSERT_TRUE(context().run(batch, results).ok());
    check_penetration(pair, PenetrationPoints::boundary, results[handle]);
    batch.clear();
    EXPECT_TRUE(context().run(batch, results).ok());
    EXPECT_TRUE(results.results.empty());
}

TEST_F(Batches, OfManySmallPairsHold) {
    constexpr int many = 300;
    Random random(batches_seed);
    std::deque<PlacedPair> pairs;
    std::vector<QueryHandle<PenetrationQuery>> handles;
    Batch batch;
    for (int i = 0; i < many; ++i) {
        const Vector2 place{10.0 * (i % 20), 10.0 * (i / 20)};
        const Vector2 beside{place.x + random.between(-1.8, 1.8), place.y + 0.4};
        pairs.emplace_back(context(), Pair{{"A", star(random, random.whole(3, 40), 0.4)},
                                           {"B", star(random, random.whole(3, 40), 0.4)},
                                           {place, random.between(0.0, 6.0)},
                                           {beside, random.between(0.0, 6.0)},
                                           random.scale(0.02, 0.2)});
        handles.push_back(batch.add(pairs.back().penetration()));
    }
    Results results;
    const Status status = context().run(batch, results);
    ASSERT_TRUE(status.ok()) << status.text();
    for (std::size_t i = 0; i < handles.size(); ++i) {
        SCOPED_TRACE(describe(pairs[i].pair()));
        check_penetration(pairs[i], PenetrationPoints::boundary, results[handles[i]]);
    }
}

TEST_F(Batches, OneShapeManyTimes) {
    // A shape against itself at several poses and tolerances in one batch.
    Random random(batches_seed);
    const PlacedPair pair(
        context(), {{"A", with_holes(random, 4)}, {"B", star(random, 30, 0.6)}, {}, {}, 0.05});
    Batch batch;
    std::vector<QueryHandle<PenetrationQuery>> handles;
    std::vector<PenetrationQuery> queries;
    for (int i = 0; i < 12; ++i) {
        PenetrationQuery query = pair.penetration();
        query.b.shape = i % 2 == 0 ? pair.instance_a().shape : pair.instance_b().shape;
        query.a.pose = {{0.15 * i - 0.9, 0.2}, 0.5 * i};
        query.tolerance = 0.02 * (1 + i % 3);
        queries.push_back(query);
        handles.push_back(batch.add(query));
    }
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    for (std::size_t i = 0; i < handles.size(); ++i) {
        SCOPED_TRACE(i);
        expect_same_answers(results[handles[i]], run_alone(context(), queries[i]));
    }
}

}  // namespace
}  // namespace nearfield::test
