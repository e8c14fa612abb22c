#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

constexpr std::uint64_t separation_bound_seed = 1833;

/// Translations that move a vertex of one shape onto an edge of the other.
struct Wall {
    Vector2 start;
    Vector2 end;
};

std::vector<Wall> walls_of(const ShapeOracle& a, const ShapeOracle& b) {
    std::vector<Wall> walls;
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        for (std::uint32_t j = 0; j < b.size(); ++j) {
            walls.push_back({oracle::minus(b.vertex(j), a.vertex(i)),
                             oracle::minus(b.vertex(b.next(j)), a.vertex(i))});
            walls.push_back({oracle::minus(b.vertex(j), a.vertex(i)),
                             oracle::minus(b.vertex(j), a.vertex(a.next(i)))});
        }
    }
    return walls;
}

double cross_of(const Vector2& i, const Vector2& j) {
    return i.x * j.y - i.y * j.x;
}

/// The intersection of two walls.
std::optional<Vector2> crossing(const Wall& first, const Wall& second) {
    const Vector2 along = oracle::minus(first.end, first.start);
    const Vector2 other = oracle::minus(second.end, second.start);
    const Vector2 between = oracle::minus(second.start, first.start);
    const double area = cross_of(along, other);
    const double part = cross_of(between, other) / area;
    const double other_part = cross_of(between, along) / area;
    constexpr double slack = 1e-9;
    const auto is_part = [](double t) { return t >= -slack && t <= 1.0 + slack; };
    if (!is_part(part) || !is_part(other_part)) {
        return std::nullopt;  // or parallel, where the quotient is not a number
    }
    return oracle::plus(first.start, oracle::times(along, part));
}

/// Where the shortest separating translation can end: perpendicular to a wall, or where walls
/// cross.
std::vector<Vector2> ends_of_ways(const std::vector<Wall>& walls) {
    std::vector<Vector2> ends;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const Vector2 along = oracle::minus(walls[i].end, walls[i].start);
        const double part = -oracle::dot(walls[i].start, along) / oracle::dot(along, along);
        if (part >= 0.0 && part <= 1.0) {
            ends.push_back(oracle::plus(walls[i].start, oracle::times(along, part)));
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (const std::optional<Vector2> end = crossing(walls[i], walls[j])) {
                ends.push_back(*end);
            }
        }
    }
    std::sort(ends.begin(), ends.end(), [](const Vector2& i, const Vector2& j) {
        return oracle::length(i) < oracle::length(j);
    });
    return ends;
}

/// The length of the shortest translation that separates the shapes, found by testing all candidate
/// ends, displaced by `little` in many directions; it may be too long by that much.
double min_separation(const ShapeOracle& a, const Rings& rings_b, const Pose& pose_b,
                      double little) {
    const ShapeOracle b(rings_b, pose_b);
    constexpr int directions = 32;
    for (const Vector2& end : ends_of_ways(walls_of(a, b))) {
        for (int i = 0; i < directions; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.3) / directions;
            // Moving A is equivalent to moving B the other way.
            const Pose moved{{pose_b.translation.x - end.x - little * std::cos(angle),
                              pose_b.translation.y - end.y - little * std::sin(angle)},
                             pose_b.angle};
            if (!oracle::intersects(a, ShapeOracle(rings_b, moved))) {
                return oracle::length(end);
            }
        }
    }
    return 0.0;
}

class SeparationBound : public QueryTest {
protected:
    static SeparationVectorResult ask(const Pair& pair, std::uint64_t max_work) {
        const PlacedPair placed(context(), pair, Technique::cpu);
        return run_alone(context(), SeparationVectorQuery{placed.instance_a(), placed.instance_b(),
                                                          pair.tolerance, max_work});
    }
    static SeparationVectorResult ask(const Pair& pair) {
        return ask(pair, SeparationVectorQuery().max_work);
    }
    static std::uint64_t edges_of(const Pair& pair) {
        std::uint64_t edges = 0;
        for (const Rings* rings : {&pair.a.rings, &pair.b.rings}) {
            for (const Ring& ring : *rings) {
                edges += ring.size();
            }
        }
        return edges;
    }
};

TEST_F(SeparationBound, TheLeastOfAllLiesBetweenBoundAndLength) {
    int intersect = 0;
    for_each_case(separation_bound_seed, 16, [&](Random& random) {
        const auto shape = [&random] {
            switch (random.whole(0, 2)) {
                case 0:
                    return star(random, random.whole(4, 6), 0.25);
                case 1:
                    return rectangle({-1.0, random.between(-0.3, -0.1)}, {1.0, 0.1});
                default:
                    return Rings{{{-1, -1}, {1, -1}, {1, 1}, {0.4, 1}, {0.4, -0.6}, {-1, -0.6}}};
            }
        };
        const Pair pair{
            {"A", shape()},
            {"B", shape()},
            {{random.between(-0.6, 0.6), random.between(-0.6, 0.6)}, random.between(-3.0, 3.0)},
            {{0.1, -0.2}, random.between(-3.0, 3.0)},
            1e-3};
        SCOPED_TRACE(describe(pair));
        const SeparationVectorResult result = ask(pair);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        if (!result.intersects) {
            return;
        }
        ++intersect;
        constexpr double little = 1e-6;
        const double least = min_separation(ShapeOracle(pair.a.rings, pair.pose_a), pair.b.rings,
                                            pair.pose_b, little);
        EXPECT_LE(result.lower_bound, least + little);
        EXPECT_LE(least, result.length + little);
        // None of these exceeds the work limit.
        EXPECT_LE(result.length - result.lower_bound, pair.tolerance);
    });
    EXPECT_GE(intersect, random_cases(16) / 2);
}

TEST_F(SeparationBound, IsCloseForOrdinaryShapes) {
    for (const int edges : {10, 50, 200}) {
        for_each_case(separation_bound_seed + 10, 4, [&](Random& random) {
            const Pair pair{
                {"A", star(random, edges, 0.5)},
                {"B", coast(random, edges, 0.3)},
                {{random.between(-0.6, 0.6), random.between(-0.6, 0.6)}, random.between(-3.0, 3.0)},
                {},
                1e-3};
            SCOPED_TRACE(describe(pair));
            const SeparationVectorResult result = ask(pair);
            ASSERT_TRUE(result.intersects);
            EXPECT_GE(result.lower_bound, 0.97 * result.length);
        });
    }
}

TEST_F(SeparationBound, IsCloseForCombsSpiralsAndSpikes) {
    for_each_case(separation_bound_seed + 20, 3, [&](Random& random) {
        const auto pose = [&random] {
            return Pose{{random.between(-0.7, 0.7), random.between(-0.7, 0.7)},
                        random.between(-3.0, 3.0)};
        };
        const std::vector<Rings> shapes{comb(5), comb(20), comb(100), spiral(3.0, 0.1, 100),
                                        star(random, 200, 0.1)};
        for (const Rings& shape : shapes) {
            const Pair pair{{"A", shape}, {"B", shape}, pose(), {}, 1e-3};
            SCOPED_TRACE(describe(pair));
            const SeparationVectorResult result = ask(pair);
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_GE(result.lower_bound, 0.95 * result.length);
        }
    });
}

TEST_F(SeparationBound, TheWorkIsBounded) {
    Random random(separation_bound_seed);
    const std::vector<Pair> pairs{
        {{"A", comb(60)}, {"B", comb(60)}, {{0.1, 0.3}, 3.0}, {}, 1e-4},
        {{"A", spiral(4.0, 0.05, 150)}, {"B", spiral(3.0, 0.1, 90)}, {{0.3, 0.1}, 1.0}, {}, 1e-4},
        {{"A", star(random, 500, 0.5)},
         {"B", star(random, 400, 0.1)},
         {{0.2, 0.1}, 1.0},
         {},
         1e-4}};
    for (const Pair& pair : pairs) {
        SCOPED_TRACE(describe(pair));
        SeparationVectorResult before;
        for (const std::uint64_t max_work : {0U, 100'000U, 1'000'000U, 10'000'000U}) {
            const SeparationVectorResult result = ask(pair, max_work);
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            ASSERT_TRUE(result.intersects);
            EXPECT_LE(result.work, max_work + 600 * edges_of(pair));
            // Both hold for any work limit.
            Pair apart = pair;
            apart.pose_a.translation = oracle::plus(pair.pose_a.translation, result.vector);
            EXPECT_FALSE(ask(apart).intersects);
            EXPECT_LE(result.lower_bound, result.length);
            if (before.intersects) {
                EXPECT_LE(before.lower_bound, result.length * (1.0 + 1e-9));
                EXPECT_LE(result.lower_bound, before.length * (1.0 + 1e-9));
            }
            before = result;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
