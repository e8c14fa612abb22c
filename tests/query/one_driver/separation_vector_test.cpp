#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

constexpr std::uint64_t separation_vector_seed = 1732;

Pose moved(const Pose& pose, const Vector2& by) {
    return {oracle::plus(pose.translation, by), pose.angle};
}

bool meet_after(const Pair& pair, const Vector2& by) {
    return oracle::intersects(ShapeOracle(pair.a.rings, moved(pair.pose_a, by)),
                              ShapeOracle(pair.b.rings, pair.pose_b));
}

/// The penetration depth of convex shapes by the separating axis theorem: the minimum over the
/// normals of all edges of the distance needed to pass the other shape.
double convex_depth(const ShapeOracle& a, const ShapeOracle& b) {
    double least = std::numeric_limits<double>::infinity();
    const auto reach = [](const ShapeOracle& shape, const Vector2& direction) {
        double most = -std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < shape.size(); ++i) {
            most = std::max(most, oracle::dot(direction, shape.vertex(i)));
        }
        return most;
    };
    for (const ShapeOracle* shape : {&a, &b}) {
        for (std::uint32_t i = 0; i < shape->size(); ++i) {
            const Vector2 along = oracle::minus(shape->vertex(shape->next(i)), shape->vertex(i));
            const double length = oracle::length(along);
            for (const double sign : {-1.0, 1.0}) {
                const Vector2 normal{-sign * along.y / length, sign * along.x / length};
                // A moves along the normal until its low side has passed B's high side.
                const double way = reach(b, normal) + reach(a, oracle::times(normal, -1.0));
                least = std::min(least, way);
            }
        }
    }
    return least;
}

/// A polygon with all its vertices on an ellipse.
Rings convex(Random& random, int n) {
    std::vector<double> angles;
    for (int i = 0; i < n; ++i) {
        angles.push_back(random.between(0.0, 2.0 * std::numbers::pi / 3.0) +
                         i % 3 * 2.0 * std::numbers::pi / 3.0);
    }
    std::sort(angles.begin(), angles.end());
    const double width = random.between(0.2, 2.0);
    Ring ring;
    for (const double angle : angles) {
        ring.push_back({width * std::cos(angle), std::sin(angle)});
    }
    return {ring};
}

class SeparationVectorTest : public QueryTest {
protected:
    static SeparationVectorResult ask(const Pair& pair) {
        const PlacedPair placed(context(), pair, Technique::cpu);
        return run_alone(context(), SeparationVectorQuery{placed.instance_a(), placed.instance_b(),
                                                          pair.tolerance});
    }

    /// Checks the guarantees of every answer; tests `samples` shorter translations.
    static SeparationVectorResult check(const Pair& pair, Random& random, int samples) {
        const CorpusKeeper keeper(pair, pair.tolerance);
        SCOPED_TRACE(describe(pair));
        const SeparationVectorResult result = ask(pair);
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.technique, Technique::cpu);
        EXPECT_NEAR(result.length, oracle::length(result.vector), 1e-15 * result.length);
        EXPECT_GE(result.lower_bound, 0.0);
        EXPECT_LE(result.lower_bound, result.length);
        EXPECT_LE(result.error_bound, result.tolerance);
        const PlacedPair rest(context(), pair, Technique::cpu);
        EXPECT_EQ(run_alone(context(), IntersectionTestQuery{rest.instance_a(), rest.instance_b()})
                      .intersects,
                  result.intersects);
        if (!result.intersects) {
            EXPECT_EQ(result.vector, Vector2{});
            return result;
        }
        check_apart(pair, result);
        for (int i = 0; i < samples; ++i) {
            const double angle = random.between(-std::numbers::pi, std::numbers::pi);
            const double far = result.lower_bound * std::sqrt(random.between(0.0, 1.0));
            EXPECT_TRUE(meet_after(pair, {far * std::cos(angle), far * std::sin(angle)}))
                << far << " at " << angle << " separates them, below " << result.lower_bound;
        }
        return result;
    }

private:
    /// Checks the separation with the library's own test and with the oracle, which is independent.
    static void check_apart(const Pair& pair, const SeparationVectorResult& result) {
        Pair apart = pair;
        apart.pose_a = moved(pair.pose_a, result.vector);
        EXPECT_FALSE(meet_after(pair, result.vector));
        const PlacedPair placed(context(), apart, Technique::cpu);
        EXPECT_FALSE(
            run_alone(context(), IntersectionTestQuery{placed.instance_a(), placed.instance_b()})
                .intersects);
        EXPECT_GT(run_alone(context(), placed.separation()).distance, 0.0);
    }
};

TEST_F(SeparationVectorTest, ConvexShapesGoTheirExactDepth) {
    for_each_case(separation_vector_seed, 60, [&](Random& random) {
        Pair pair{
            {"A", convex(random, random.whole(6, 20))},
            {"B", convex(random, random.whole(6, 20))},
            {{random.between(-0.6, 0.6), random.between(-0.6, 0.6)}, random.between(-3.0, 3.0)},
            {},
            1e-6};
        const SeparationVectorResult result = check(pair, random, 20);
        if (result.intersects) {
            const double depth = convex_depth(ShapeOracle(pair.a.rings, pair.pose_a),
                                              ShapeOracle(pair.b.rings, pair.pose_b));
            EXPECT_NEAR(result.length, depth, 1e-5 * depth + 1e-9);
            EXPECT_LE(result.lower_bound, depth + result.error_bound);
        }
    });
}

TEST_F(SeparationVectorTest, HoldsForRandomPairs) {
    int intersect = 0;
    for_each_case(separation_vector_seed + 500, 40, [&](Random& random) {
        intersect += check(any_pair(random), random, 25).intersects ? 1 : 0;
    });
    EXPECT_GT(intersect, random_cases(40) / 4);
}

TEST_F(SeparationVectorTest, HoldsForDegeneratePolygons) {
    Random random(separation_vector_seed);
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), 40, separation_vector_seed);
    int intersect = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Pair pair{shapes[i], shapes[(i + 5) % shapes.size()], {}, {{1.3, -0.7}, 0.1}, 0.7};
        intersect += check(pair, random, 15).intersects ? 1 : 0;
    }
    EXPECT_GE(intersect, 3);
}

TEST_F(SeparationVectorTest, KnownWays) {
    Random random(separation_vector_seed);
    const Rings square = rectangle({-1, -1}, {1, 1});
    const auto pair = [](const Rings& a, const Rings& b, const Vector2& at) {
        return Pair{{"A", a}, {"B", b}, {at, 0.0}, {}, 1e-3};
    };
    SeparationVectorResult result = check(pair(square, square, {1.25, 0.5}), random, 20);
    EXPECT_NEAR(result.vector.x, 0.75, 1e-9);
    EXPECT_NEAR(result.vector.y, 0.0, 1e-9);
    EXPECT_GE(result.lower_bound, 0.749);
    // Out of a frame's wall, inwards into its hole.
    const Rings frame{rectangle({-9, -9}, {9, 9})[0], rectangle({-5, -5}, {5, 5})[0]};
    result = check(pair(square, frame, {4.5, 0.25}), random, 20);
    EXPECT_NEAR(result.vector.x, -0.5, 1e-9);
    // A shape that does not fit into the hole must leave the frame altogether.
    result = check(pair(rectangle({-6, -6}, {6, 6}), frame, {1.0, 0.0}), random, 20);
    EXPECT_NEAR(result.length, 14.0, 1e-9);
    // A slot with a bar in it: the bar leaves through the slot's mouth, not sideways through the
    // walls.
    const Rings slot{{{-3, -3}, {3, -3}, {3, 3}, {1, 3}, {1, -2}, {-1, -2}, {-1, 3}, {-3, 3}}};
    result = check(pair(rectangle({-0.9, 0}, {0.9, 9}), slot, {0.0, -2.25}), random, 20);
    EXPECT_NEAR(result.vector.y, 0.25, 1e-9);
    EXPECT_NEAR(result.vector.x, 0.0, 1e-9);
    // Disjoint, and touching.
    EXPECT_EQ(check(pair(square, square, {2.5, 0.0}), random, 0).length, 0.0);
    EXPECT_LT(check(pair(square, square, {2.0, 0.0}), random, 0).length, 1e-12);
}

TEST_F(SeparationVectorTest, OfThinBarsThatCrossTheBoundIsCloseToo) {
    const Rings bar = rectangle({-5, -0.1}, {5, 0.1});
    for_each_case(separation_vector_seed + 1200, 20, [&](Random& random) {
        const Pair pair{
            {"A", bar},
            {"B", bar},
            {{random.between(-1.5, 1.5), random.between(-1.5, 1.5)}, random.between(0.5, 2.5)},
            {},
            0.01};
        const SeparationVectorResult result = check(pair, random, 20);
        ASSERT_TRUE(result.intersects);
        EXPECT_LE(result.length - result.lower_bound, pair.tolerance);
    });
}

TEST_F(SeparationVectorTest, OutlinesComeApart) {
    Random random(separation_vector_seed);
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    for (std::size_t i = 0; i < outlines.size(); i += 2) {
        const Pair pair{
            outlines[i], outlines[(i + 1) % outlines.size()], {{150.0, 20.0}, 0.2}, {}, 5.0};
        EXPECT_TRUE(check(pair, random, 10).intersects) << outlines[i].name;
    }
}

TEST_F(SeparationVectorTest, LawsOfSymmetry) {
    for_each_case(separation_vector_seed + 1500, 25, [&](Random& random) {
        Pair pair = any_pair(random);
        SCOPED_TRACE(describe(pair));
        const SeparationVectorResult result = ask(pair);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        // A bound for one order of the shapes holds for the other order too.
        const auto expect_same = [&](const SeparationVectorResult& other, const char* what) {
            ASSERT_EQ(other.intersects, result.intersects) << what;
            // Vectors are longer than where the shapes touch by a few roundings of both.
            const double rounding = 8.0 * (result.error_bound + other.error_bound);
            EXPECT_LE(result.lower_bound, other.length * (1.0 + 1e-9) + rounding) << what;
            EXPECT_LE(other.lower_bound, result.length * (1.0 + 1e-9) + rounding) << what;
        };
        expect_same(ask({pair.b, pair.a, pair.pose_b, pair.pose_a, pair.tolerance}), "swapped");
        const double size = oracle::length(pair.pose_a.translation) + 1.0;
        for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
            const double cosine = std::cos(0.7);
            const double sine = std::sin(0.7);
            const auto [x, y] = pose->translation;
            *pose = {{cosine * x - sine * y + size, sine * x + cosine * y}, pose->angle + 0.7};
        }
        expect_same(ask(pair), "seen from elsewhere");
    });
}

}  // namespace
}  // namespace nearfield::test
