#include "containment_queries.hpp"

namespace nearfield::test {
namespace {

constexpr std::uint64_t containment_seed = 2718;

TEST_F(ContainmentQueries, HoldForRandomPairs) {
    int inside = 0;
    for_each_case(containment_seed, 400,
                  [&](Random& random) { inside += check(nested_pair(random)).inside ? 1 : 0; });
    EXPECT_GT(inside, random_cases(400) / 20);
    EXPECT_LT(inside, random_cases(400) / 2);
}

TEST_F(ContainmentQueries, HoldForEveryFamilyInOthers) {
    const std::vector<NamedRings> shapes = every_family(containment_seed);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const std::size_t apart : {1U, 4U, 6U}) {
            const NamedRings& a = shapes[i];
            const NamedRings& b = shapes[(i + apart) % shapes.size()];
            Pair pair{a, b, {{0.35, 0.1}, 0.7}, {{0.0, 0.0}, 0.2}, 0.01};
            check(pair);
            pair.a.rings = scaled_and_moved(pair.a.rings, 0.05, {});
            check(pair);
        }
    }
}

TEST_F(ContainmentQueries, HoldForDegenerateShapes) {
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), 24, containment_seed);
    ASSERT_GE(shapes.size(), 6U);
    for (const NamedRings& shape : shapes) {
        EXPECT_TRUE(check(Pair{shape, shape, {}, {}, 0.1}).inside) << shape.name;
        check(Pair{shape, {"room", rectangle({-1, -1}, {25, 25})}, {}, {}, 0.1});
        check(Pair{{"box", rectangle({9.5, 9.5}, {14.25, 12.25})}, shape, {}, {}, 0.1});
        for (const NamedRings& other : shapes) {
            check(Pair{shape, other, {}, {}, 0.1});
        }
    }
}

TEST_F(ContainmentQueries, OfKnownShapes) {
    const Rings room = rectangle({0, 0}, {10, 10});
    ContainmentResult result = check(rectangle({2, 3}, {4, 6}), room);
    EXPECT_TRUE(result.inside);
    EXPECT_EQ(result.clearance, 2.0);
    EXPECT_NEAR(result.direction.x, -1.0, 1e-15);
    EXPECT_NEAR(result.direction.y, 0.0, 1e-15);
    EXPECT_EQ(result.feature_b.index, 3U);
    EXPECT_FALSE(result.unique);  // the whole left side is as near
    result = check(Rings{{{2, 5}, {5, 3}, {6, 6}}}, room);
    EXPECT_TRUE(result.unique);
    EXPECT_EQ(result.feature_a.kind, Feature::Kind::vertex);
    EXPECT_EQ(result.feature_a.index, 0U);
    EXPECT_EQ(result.point_b, (Vector2{0.0, 5.0}));
    // The boundary of a hole counts, also of one that A surrounds with a larger hole.
    const Rings frame{room[0], rectangle({4, 4}, {6, 6})[0]};
    EXPECT_EQ(check(rectangle({1.5, 1.5}, {3, 5}), frame).clearance, 1.0);
    EXPECT_EQ(
        check(Rings{rectangle({1, 1}, {9, 9})[0], rectangle({3.5, 3.5}, {6.5, 6.5})[0]}, frame)
            .clearance,
        0.5);
    EXPECT_FALSE(check(rectangle({1, 1}, {9, 9}), frame).inside);
    result = check(rectangle({0, 2}, {3, 3}), room);
    EXPECT_TRUE(result.inside);
    EXPECT_EQ(result.clearance, 0.0);
    EXPECT_EQ(result.point_a.x, 0.0);
    // An island in a hole.
    const Rings target{room[0], frame[1], rectangle({4.5, 4.5}, {5.5, 5.5})[0]};
    EXPECT_NEAR(check(rectangle({4.75, 4.75}, {5, 5}), target).clearance, 0.25, 1e-15);
    EXPECT_FALSE(check(rectangle({4.1, 4.1}, {4.4, 4.4}), target).inside);
}

TEST_F(ContainmentQueries, RigidMotionsOfBothLeaveTheAnswer) {
    for_each_case(containment_seed + 1, 150, [&](Random& random) {
        const Pair pair = nested_pair(random);
        const ContainmentResult rest = ask(pair);
        const double angle = random.between(-4.0, 4.0);
        const Vector2 by{random.between(-30.0, 30.0), random.between(-30.0, 30.0)};
        const auto moved = [&](const Pose& pose) {
            const auto& [x, y] = pose.translation;
            return Pose{{std::cos(angle) * x - std::sin(angle) * y + by.x,
                         std::sin(angle) * x + std::cos(angle) * y + by.y},
                        pose.angle + angle};
        };
        Pair turned = pair;
        turned.pose_a = moved(pair.pose_a);
        turned.pose_b = moved(pair.pose_b);
        const ContainmentResult other = ask(turned);
        const double bound = 4.0 * (rest.error_bound + other.error_bound);
        if (rest.inside && rest.clearance > bound) {
            EXPECT_TRUE(other.inside) << describe(pair);
            EXPECT_NEAR(other.clearance, rest.clearance, bound) << describe(pair);
        } else if (other.inside) {
            EXPECT_LE(other.clearance, bound) << describe(pair);
        }
    });
}

TEST_F(ContainmentQueries, StarsLieInGrownCopiesAndNotInShrunkOnes) {
    for_each_case(containment_seed + 2, 40, [&](Random& random) {
        const Rings shape = star(random, random.whole(3, 300), random.between(0.1, 0.9));
        const Pose pose{{random.between(-9.0, 9.0), random.between(-9.0, 9.0)},
                        random.between(-4.0, 4.0)};
        const auto in_copy = [&](double factor) {
            return check(
                Pair{{"A", shape}, {"B", scaled_and_moved(shape, factor, {})}, pose, pose, 0.1});
        };
        const ContainmentResult same = in_copy(1.0);
        EXPECT_TRUE(same.inside);
        EXPECT_EQ(same.clearance, 0.0);
        double last = 0.0;
        for (const double growth : {1e-9, 1e-3, 0.1, 1.0}) {
            const ContainmentResult grown = in_copy(1.0 + growth);
            EXPECT_TRUE(grown.inside);
            EXPECT_GT(grown.clearance, last);
            EXPECT_LE(grown.clearance, growth * (1.0 + 1e-9) + grown.error_bound);
            last = grown.clearance;
            EXPECT_FALSE(in_copy(1.0 / (1.0 + growth)).inside);
        }
    });
}

TEST_F(ContainmentQueries, AShapeIsInItselfHoweverItsEdgesAreDivided) {
    for_each_case(containment_seed + 5, 400, [&](Random& random) {
        Pair pair = any_pair(random);
        pair.b.rings = with_collinear_runs(random, pair.a.rings, random.between(0.1, 1.0));
        pair.pose_b = pair.pose_a;
        EXPECT_TRUE(ask(pair).inside) << describe(pair);
        std::swap(pair.a, pair.b);
        EXPECT_TRUE(ask(pair).inside) << describe(pair);
    });
}

TEST_F(ContainmentQueries, ClearanceIsHowFarAMayGo) {
    int tried = 0;
    for_each_case(containment_seed + 3, 300, [&](Random& random) {
        Pair pair = nested_pair(random);
        const Pose start = pair.pose_a;
        const ContainmentResult rest = ask(pair);
        if (!rest.inside || rest.clearance < 1e-6) {
            return;
        }
        ++tried;
        const auto moved_by = [&](const Vector2& way) {
            pair.pose_a = {oracle::plus(start.translation, way), start.angle};
            return ask(pair);
        };
        const double angle = random.between(-4.0, 4.0);
        const Vector2 anywhere{std::cos(angle), std::sin(angle)};
        EXPECT_TRUE(moved_by(oracle::times(anywhere, 0.999 * rest.clearance)).inside)
            << describe(pair);
        // Towards B's boundary it arrives there.
        const ContainmentResult nearer =
            moved_by(oracle::times(rest.direction, 0.75 * rest.clearance));
        EXPECT_TRUE(nearer.inside) << describe(pair);
        EXPECT_NEAR(nearer.clearance, 0.25 * rest.clearance,
                    4.0 * (rest.error_bound + nearer.error_bound))
            << describe(pair);
    });
    EXPECT_GT(tried, random_cases(300) / 30);
}

TEST_F(ContainmentQueries, AreTransitiveAndClearancesAddUp) {
    for_each_case(containment_seed + 4, 100, [&](Random& random) {
        const Rings inner = star(random, random.whole(3, 60), 0.3);
        const Rings middle =
            scaled_and_moved(star(random, random.whole(3, 60), 0.6), random.scale(1.0, 8.0), {});
        const Rings outer =
            scaled_and_moved(star(random, random.whole(3, 60), 0.6), random.scale(4.0, 40.0), {});
        const ContainmentResult first = check(inner, middle);
        const ContainmentResult second = check(middle, outer);
        if (first.inside && second.inside) {
            const ContainmentResult both = check(inner, outer);
            EXPECT_TRUE(both.inside);
            EXPECT_GE(both.clearance + both.error_bound + first.error_bound + second.error_bound,
                      first.clearance + second.clearance);
        }
    });
}

TEST_F(ContainmentQueries, OfOutlines) {
    for (const NamedRings& outline : read_outlines(NEARFIELD_TEST_DATA)) {
        Pair pair{outline, outline, {{}, 0.4}, {{}, 0.4}, 0.5};
        const ContainmentResult self = ask(pair);
        EXPECT_TRUE(self.inside) << outline.name;
        EXPECT_EQ(self.clearance, 0.0);
        pair.pose_a.translation.x += 1e-3;
        EXPECT_FALSE(ask(pair).inside) << outline.name;
        const Rectangle box = ShapeOracle(outline.rings).box();
        pair = {outline, {"box", rectangle(oracle::minus(box.min, {1, 2}), box.max)}, {}, {}, 0.5};
        EXPECT_EQ(check(pair).clearance, 0.0);
        pair.b.rings = rectangle(oracle::minus(box.min, {1, 2}), oracle::plus(box.max, {3, 4}));
        EXPECT_NEAR(check(pair).clearance, 1.0, 1e-9);
    }
}

}  // namespace
}  // namespace nearfield::test
