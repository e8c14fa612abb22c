#include <shaders/search.h>
#include <tests/query/agreement.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t point_search_seed = 18000;

/// Points of a boundary that the device searches by itself (technique compute), compared with the
/// oracle and with technique cpu.
class PointSearch : public QueryTest {
protected:
    /// Penetration of boundary and vertices, and contacts, of all pairs in one batch.
    static void check(Context& context, const std::vector<Pair>& pairs) {
        std::vector<std::unique_ptr<PlacedPair>> placed;
        Batch batch;
        for (const Pair& pair : pairs) {
            placed.push_back(std::make_unique<PlacedPair>(context, pair, Technique::compute));
            add(*placed.back(), Technique::compute, batch);
        }
        Results found;
        ASSERT_TRUE(context.run(batch, found).ok());
        for (std::size_t i = 0; i < placed.size(); ++i) {
            SCOPED_TRACE(describe(pairs[i]));
            check(*placed[i], context, &found.results[queries_per_pair * i]);
        }
    }

    /// All numbers of the answer of a query alone.
    template <class Query>
    static std::vector<double> numbers(Context& context, const Query& query) {
        return numbers_of(run_alone(context, query));
    }

    template <class Result>
    static std::vector<double> numbers_of(Result result) {
        Results results;
        results.results.emplace_back(std::move(result));
        return all_numbers(results);
    }

    /// Depths in B of the first vertices of A, whose own frame is turned by `angle`, so that the
    /// device rounds where they are. The tolerance is far below single precision.
    void check_row(const Rings& b, const std::vector<Vector2>& row,
                   const std::vector<double>& depths, double angle) {
        Pair pair;
        pair.b = {"walls", b};
        pair.a.name = "row";
        Ring& turned = pair.a.rings.emplace_back();
        for (const Vector2& vertex : row) {
            turned.push_back({vertex.x * std::cos(angle) - vertex.y * std::sin(angle),
                              vertex.x * std::sin(angle) + vertex.y * std::cos(angle)});
        }
        turned.push_back({-30.0 * std::sin(angle), 30.0 * std::cos(angle)});
        pair.pose_a.angle = -angle;
        pair.tolerance = 1e-7;
        const PlacedPair placed(context(), pair, Technique::compute);
        const PenetrationResult found =
            run_alone(context(), placed.penetration(PenetrationPoints::vertices));
        ASSERT_EQ(found.points.size(), depths.size());
        for (std::size_t i = 0; i < depths.size(); ++i) {
            EXPECT_NEAR(found.points[i].depth, depths[i], found.error_bound) << "vertex " << i;
        }
    }

    static double contact_distance_of(const PlacedPair& pair) { return 2.0 * pair.tolerance(); }

private:
    static constexpr std::size_t queries_per_pair = 3;

    static void add(const PlacedPair& pair, Technique technique, Batch& batch) {
        const auto add_by_technique = [&](auto query) {
            query.technique = technique;
            batch.add(query);
        };
        add_by_technique(pair.penetration());
        add_by_technique(pair.penetration(PenetrationPoints::vertices));
        add_by_technique(pair.contacts(contact_distance_of(pair)));
    }

    /// Without records, only the points that may decide the summary are made exact: it is the same.
    static void check_summary(const PlacedPair& pair, PenetrationPoints points, Context& context,
                              PenetrationResult found) {
        PenetrationQuery query = pair.penetration(points);
        query.technique = Technique::compute;
        query.summary_only = true;
        found.points.clear();
        EXPECT_EQ(numbers(context, query), numbers_of(std::move(found)));
    }

    static void check(const PlacedPair& pair, Context& context, const AnyResult* found) {
        for (const auto& [points, result] : {std::pair(PenetrationPoints::boundary, found),
                                             std::pair(PenetrationPoints::vertices, found + 1)}) {
            check_penetration(pair, points, std::get<PenetrationResult>(*result));
            check_summary(pair, points, context, std::get<PenetrationResult>(*result));
        }
        check_contacts(pair, contact_distance_of(pair), std::get<ContactResult>(found[2]));
        Batch batch;
        add(pair, Technique::cpu, batch);
        Results expected;
        ASSERT_TRUE(context.run(batch, expected).ok());
        for (std::size_t i = 0; i < queries_per_pair; ++i) {
            check_agreement({pair, batch.queries()[i]}, found[i],
                            by_technique_of(found[i], expected.results[i]));
        }
    }
};

// The tolerance is so small against the shapes that single precision cannot name the feature.
TEST_F(PointSearch, HoldsWhereSinglePrecisionLeavesDoubt) {
    for_each_case(point_search_seed + 1000, 20, [&](Random& random) {
        Pair pair = any_pair(random);
        // A small part of A's boundary lies in B, so that the samples stay few.
        pair.a.rings = scaled_and_moved(star(random, 5, 0.5), 0.01, {});
        pair.a.name = "small star";
        pair.b.rings = coast(random, random.whole(8, 400), 0.4);
        pair.b.name = "coast";
        const double angle = random.between(0.0, 2.0 * std::numbers::pi);
        const Vector2 world{random.between(-1e4, 1e4), random.between(-1e4, 1e4)};
        pair.pose_b = pose_at({}, world, angle);
        pair.pose_a = pose_at({}, {world.x + random.between(0.3, 1.0), world.y}, -angle);
        pair.tolerance = random.scale(1e-6, 1e-4);
        check(context(), {pair});
    });
}

// Vertices of A nearer to B's boundary than single precision can tell, on either side.
TEST_F(PointSearch, DecidesTheSideWhereSinglePrecisionCannot) {
    for_each_case(point_search_seed + 3000, 6, [&](Random& random) {
        Pair pair;
        pair.b = {"coast", coast(random, 300, 0.2)};
        pair.a = {"nearly the same", pair.b.rings};
        for (Vector2& vertex : pair.a.rings.front()) {
            const double move = random.scale(1e-10, 1e-6);
            const double angle = random.between(-std::numbers::pi, std::numbers::pi);
            vertex = {vertex.x + move * std::cos(angle), vertex.y + move * std::sin(angle)};
        }
        pair.pose_a = pair.pose_b = {{random.between(-10, 10), random.between(-10, 10)}, 0.7};
        pair.tolerance = 1e-5;
        const PlacedPair placed(context(), pair, Technique::compute);
        const PenetrationResult found =
            run_alone(context(), placed.penetration(PenetrationPoints::vertices));
        // To a tolerance like this one the oracle needs minutes.
        PenetrationQuery query = placed.penetration(PenetrationPoints::vertices);
        query.technique = Technique::cpu;
        const PenetrationResult expected = run_alone(context(), query);
        check_agreement({placed, query}, found, by_technique_of(found, expected));
        EXPECT_GT(found.count, 50U);
        EXPECT_LT(found.count, 250U);
    });
}

// Vertices of A so near to the middle between two walls of B that single precision cannot tell
// which is nearer. Four that follow each other lie together, as the device searches for them at
// once.
TEST_F(PointSearch, DecidesTheNearerWallWhereSinglePrecisionCannot) {
    for_each_case(point_search_seed + 4000, 4, [&](Random& random) {
        constexpr int walls = 40;
        Ring strip;
        for (int i = 0; i <= walls; ++i) {
            strip.push_back({-10.0 + 20.0 * i / walls, -1.0});
        }
        for (int i = walls; i >= 0; --i) {
            strip.push_back({-10.0 + 20.0 * i / walls, 1.0});
        }
        std::vector<Vector2> row;
        std::vector<double> depths;
        for (int i = 0; i < 400; ++i) {
            const bool is_first = i % 4 == 0;
            row.push_back(is_first ? Vector2{-8.0 + 0.04 * i, random.between(-1e-6, 1e-6)}
                                   : Vector2{row.back().x + 1e-7, row.back().y});
            depths.push_back(1.0 - std::abs(row.back().y));
        }
        check_row({strip}, row, depths, random.between(-3.0, 3.0));
    });
}

// Walls of B so close behind each other that single precision takes their points for one.
TEST_F(PointSearch, DecidesTheNearestOfWallsThatSinglePrecisionTakesForOne) {
    for_each_case(point_search_seed + 5000, 4, [&](Random& random) {
        const Ring around{{-100.0, -100.0}, {100.0, -100.0}, {100.0, 1.0}, {-100.0, 1.0}};
        Ring slit{{-99.0, 1.0 - 6e-7}, {99.0, 1.0 - 6e-7}, {99.0, 1.0 - 3e-7}, {-99.0, 1.0 - 3e-7}};
        std::vector<Vector2> row;
        std::vector<double> depths;
        for (int i = 0; i < 400; ++i) {
            row.push_back({-8.0 + 0.04 * i, random.between(-30.0, -20.0)});
            depths.push_back(1.0 - 6e-7 - row.back().y);
        }
        check_row({around, slit}, row, depths, random.between(-3.0, 3.0));
        // The nearest wall is the last of those that look the same.
        std::rotate(slit.begin(), slit.begin() + 2, slit.end());
        check_row({around, slit}, row, depths, random.between(-3.0, 3.0));
    });
}

// Rays across all teeth of a comb: the walks of the device end before they have seen all edges.
TEST_F(PointSearch, LeavesLongWalksToTheCpu) {
    for_each_case(point_search_seed + 6000, 4, [&](Random& random) {
        const std::size_t edges = 70000;
        const bool is_comb = random.whole(0, 2) == 0;
        Pair pair;
        pair.a = {"star", star(random, 40, 0.3)};
        pair.b = is_comb ? NamedRings{"comb", comb(static_cast<int>(edges / 4))}
                         : NamedRings{"coast", coast(random, edges, 0.5)};
        pair.pose_a.translation = {random.between(-0.7, 0.7), random.between(-0.7, 0.7)};
        pair.tolerance = 0.01;
        const PlacedPair placed(context(), pair, Technique::compute);
        for (const PenetrationPoints points :
             {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            PenetrationQuery query = placed.penetration(points);
            const PenetrationResult found = run_alone(context(), query);
            query.technique = Technique::cpu;
            const PenetrationResult expected = run_alone(context(), query);
            check_agreement({placed, query}, found, by_technique_of(found, expected));
            EXPECT_GT(found.count, 0U);
        }
    });
}

// Sizes apart by four orders of magnitude, rings in dozens, and coordinates of a million.
TEST_F(PointSearch, HoldsForMixedSizesFarFromTheOrigin) {
    for_each_case(point_search_seed + 2000, 6, [&](Random& random) {
        const Vector2 world{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
        std::vector<Pair> pairs;
        for (int i = 0; i < 4; ++i) {
            const double size = random.scale(1.0, 1e4);
            Pair pair;
            pair.a = {"star", star(random, random.whole(3, 40), 0.4)};
            pair.b = {"parts", several_parts(random, random.whole(2, 60))};
            pair.b.rings = scaled_and_moved(pair.b.rings, size, {});
            pair.pose_b = pose_at({}, world, random.between(-3.0, 3.0));
            const double along = random.between(-3.0, 3.0);
            const double away = random.between(0.2, 1.0) * size;
            pair.pose_a = pose_at(
                {}, {world.x + away * std::cos(along), world.y + away * std::sin(along)}, along);
            pair.tolerance = random.scale(0.005, 0.1);
            pairs.push_back(pair);
        }
        check(context(), pairs);
    });
}

// Squares of lengths would leave the range of single precision in world units.
TEST_F(PointSearch, HoldsForShapesOfAnySize) {
    Random random(point_search_seed + 4000);
    std::vector<Pair> pairs;
    for (const double size : {1e-19, 1e-12, 1e-6, 1e3, 1e9}) {
        for (int i = 0; i < 4; ++i) {
            Pair pair;
            pair.a = {"star", scaled_and_moved(star(random, 40, 0.4), size, {})};
            pair.b = {"parts", scaled_and_moved(several_parts(random, 3), size, {})};
            pair.pose_a = {{random.between(-0.5, 0.5) * size, 0.0}, random.between(-3.0, 3.0)};
            pair.tolerance = random.scale(1e-4, 1e-2) * size;
            pairs.push_back(pair);
        }
    }
    check(context(), pairs);
}

// More points than a new context makes room for: the search is repeated, and nothing is cut.
TEST_F(PointSearch, RepeatsWithMoreRoom) {
    Expected<Context> fresh = Context::create(host_device(), on_demand());
    ASSERT_TRUE(fresh.has_value()) << fresh.error().text();
    Random random(point_search_seed);
    const Pair pair{
        {"coast", coast(random, 500, 0.4)}, {"square", rectangle({-2, -2}, {2, 2})}, {}, {}, 1e-4};
    const PlacedPair placed(*fresh, pair, Technique::compute);
    const PenetrationResult first = run_alone(*fresh, placed.penetration());
    ASSERT_TRUE(first.status.ok()) << first.status.text();
    PenetrationQuery by_cpu = placed.penetration();
    by_cpu.technique = Technique::cpu;
    const PenetrationResult expected = run_alone(*fresh, by_cpu);
    EXPECT_GT(first.count, 20000U);
    EXPECT_EQ(first.count, expected.count);
    Results all;
    all.results.emplace_back(first);
    EXPECT_EQ(all_numbers(all), numbers(*fresh, placed.penetration()));
}

// Long boundaries of which little lies in B: what the device may find is counted for each query,
// and many of them take several searches.
TEST_F(PointSearch, IsDividedWhereItMayFindMuch) {
    Random random(point_search_seed + 1);
    const Pair pair{{"star", star(random, 30, 0.5)},
                    {"square", rectangle({0.5, -0.02}, {2, 0.02})},
                    {},
                    {},
                    1e-5};
    const PlacedPair placed(context(), pair, Technique::compute);
    Batch batch;
    std::vector<QueryHandle<PenetrationQuery>> handles;
    for (int i = 0; i < 6; ++i) {
        handles.push_back(batch.add(placed.penetration()));
    }
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    check_penetration(placed, PenetrationPoints::boundary, results[handles.front()]);
    const std::vector<double> first = numbers(context(), placed.penetration());
    std::vector<double> six;
    for (const auto handle : handles) {
        EXPECT_GT(results[handle].count, 100U);
        six.insert(six.end(), first.begin(), first.end());
    }
    EXPECT_EQ(all_numbers(results), six);
}

// B has boxes on five levels: three of the highest level, all of which come near a small star.
TEST_F(PointSearch, HoldsForTensOfThousandsOfEdges) {
    constexpr std::size_t edges = 70000;
    Ring gear;
    for (std::size_t i = 0; i < edges; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / edges;
        const double radius = i % 2 == 0 ? 1.0 : 1.0 + 1e-4;
        gear.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    Random random(point_search_seed + 6000);
    const Pair pair{
        {"star", scaled_and_moved(star(random, 30, 0.6), 1.1, {})}, {"gear", {gear}}, {}, {}, 0.01};
    const PlacedPair placed(context(), pair, Technique::compute);
    PenetrationQuery query = placed.penetration();
    const PenetrationResult found = run_alone(context(), query);
    query.technique = Technique::cpu;
    const PenetrationResult expected = run_alone(context(), query);
    check_agreement({placed, query}, found, by_technique_of(found, expected));
    EXPECT_GT(found.count, 100U);
}

// So many blocks of edges that each thread that scans them takes dozens.
TEST_F(PointSearch, HoldsForManyBlocks) {
    Random random(point_search_seed + 7000);
    const Rings large = coast(random, 3000 * shaders::search_block, 0.1);
    const Pair pair{{"coast", large}, {"square", rectangle({-0.8, -2}, {2, 2})}, {}, {}, 0.01};
    const PlacedPair placed(context(), pair, Technique::compute);
    PenetrationQuery query = placed.penetration(PenetrationPoints::vertices);
    const std::uint32_t found = run_alone(context(), query).count;
    query.technique = Technique::cpu;
    EXPECT_EQ(found, run_alone(context(), query).count);
    EXPECT_GT(found, 100'000U);
}

}  // namespace
}  // namespace nearfield::test
