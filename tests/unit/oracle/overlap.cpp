#include <gtest/gtest.h>
#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::oracle {
namespace {

using test::Random;
using test::Rings;

constexpr std::uint64_t overlap_seed = 77001;

TEST(OracleOverlap, AreasOfSimpleShapes) {
    const ShapeOracle big(test::rectangle({0, 0}, {10, 10}));
    const ShapeOracle cut(test::rectangle({6, 7}, {20, 30}));
    EXPECT_NEAR(area(big), 100.0, 1e-12);
    const Overlap both = overlap(big, cut);
    EXPECT_NEAR(both.area, 12.0, 1e-12);
    EXPECT_NEAR(both.box.min.x, 6.0, 1e-12);
    EXPECT_NEAR(both.box.max.y, 10.0, 1e-12);
    EXPECT_EQ(overlap(big, ShapeOracle(test::rectangle({11, 0}, {12, 1}))).area, 0.0);
}

TEST(OracleOverlap, FillsByTheOddEvenRule) {
    // A hole, an island in it, and a doubled ring, which therefore fills nothing.
    Rings rings = test::rectangle({0, 0}, {10, 10});
    rings.push_back(test::rectangle({2, 2}, {8, 8})[0]);
    rings.push_back(test::rectangle({4, 4}, {6, 6})[0]);
    rings.push_back(test::rectangle({20, 20}, {21, 21})[0]);
    rings.push_back(rings.back());
    EXPECT_NEAR(area(ShapeOracle(rings)), 100.0 - 36.0 + 4.0, 1e-12);
    // The middle of the pentagram is outside: five points without the pentagon between them.
    const double inner = std::cos(0.4 * std::numbers::pi) / std::cos(0.2 * std::numbers::pi);
    const double tip =
        std::sin(0.2 * std::numbers::pi) * inner * (1.0 - inner * std::cos(0.2 * std::numbers::pi));
    EXPECT_NEAR(area(ShapeOracle(test::pentagram())), 5 * tip, 1e-12);
}

TEST(OracleOverlap, ProtrusionOfSimpleShapes) {
    const auto box = [](double x0, double y0, double x1, double y1) {
        return test::rectangle({x0, y0}, {x1, y1});
    };
    Rings frame = box(0, 0, 10, 10);
    frame.push_back(box(4, 4, 6, 6)[0]);
    const ShapeOracle framed(frame);
    const auto protrusion_of = [&](const Rings& rings) {
        return protrusion(ShapeOracle(rings), framed);
    };
    EXPECT_EQ(protrusion_of(frame), 0.0);
    EXPECT_EQ(protrusion_of(box(1, 1, 3, 9)), 0.0);
    EXPECT_EQ(protrusion_of(box(0, 0, 4, 10)), 0.0);  // touches from inside
    EXPECT_NEAR(protrusion_of(box(1, 1, 3, 13)), 3.0, 1e-12);
    EXPECT_NEAR(protrusion_of(box(20, 0, 21, 1)), 11.0, 1e-12);
    EXPECT_NEAR(protrusion_of(box(4, 4, 6, 6)), 1.0, 1e-12);      // fills the hole
    EXPECT_NEAR(protrusion_of(box(1, 4.5, 9, 5.5)), 1.0, 1e-12);  // across the hole
    // A line without area that reaches out.
    EXPECT_NEAR(protrusion_of({{{1, 1}, {2, 1}, {2, 2}, {-5, 2}, {2, 2}, {2, 3}}}), 5.0, 1e-12);
}

TEST(OracleOverlap, AreaAgreesWithThrownPoints) {
    Random random(overlap_seed);
    const auto shapes = test::every_family(overlap_seed);
    constexpr int thrown = 8000;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        SCOPED_TRACE(shapes[i].name);
        const ShapeOracle a(shapes[i].rings);
        const ShapeOracle b(shapes[(i + 4) % shapes.size()].rings, {{0.2, 0.1}, 1.0});
        int inside = 0;
        for (int k = 0; k < thrown; ++k) {
            const Vector2 p{random.between(-1.3, 1.3), random.between(-1.3, 1.3)};
            inside += a.contains(p) && b.contains(p) ? 1 : 0;
        }
        const double square = 2.6 * 2.6;
        const double share = overlap(a, b).area / square;
        // Five standard deviations, plus one point for shares near zero.
        const double allowed = 5 * std::sqrt(share * (1 - share) / thrown) + 1.0 / thrown;
        EXPECT_NEAR(static_cast<double>(inside) / thrown, share, allowed);
    }
}

TEST(OracleOverlap, IntersectsCountsTouchingAndContainment) {
    const ShapeOracle square(test::rectangle({0, 0}, {2, 2}));
    EXPECT_TRUE(intersects(square, ShapeOracle(test::rectangle({2, 0}, {3, 2}))));
    EXPECT_TRUE(intersects(square, ShapeOracle(test::rectangle({2, 2}, {3, 3}))));
    EXPECT_TRUE(intersects(square, ShapeOracle(test::rectangle({0.5, 0.5}, {1, 1}))));
    EXPECT_TRUE(intersects(ShapeOracle(test::rectangle({0.5, 0.5}, {1, 1})), square));
    EXPECT_FALSE(intersects(square, ShapeOracle(test::rectangle({2.000001, 0}, {3, 2}))));
    Rings ring = test::rectangle({-9, -9}, {9, 9});
    ring.push_back(test::rectangle({-3, -3}, {3, 3})[0]);
    EXPECT_FALSE(intersects(square, ShapeOracle(ring)));  // inside the hole
    EXPECT_NEAR(boundary_distance(square, ShapeOracle(ring)), 1.0, 1e-12);
    ring.push_back(test::rectangle({2.5, 2.5}, {2.6, 2.6})[0]);
    EXPECT_FALSE(intersects(ShapeOracle(ring), square));
}

TEST(OracleOverlap, PoseForOverlapIsFound) {
    Random random(overlap_seed);
    const Rings a = test::star(random, 50, 0.7);
    const Rings b = test::scaled_and_moved(test::coast(random, 200, 0.4), 2.0, {300.0, -40.0});
    const ShapeOracle oracle_a(a);
    for (const double share : {0.01, 0.1, 0.5}) {
        const auto pose = pose_for_overlap(oracle_a, b, 0.7, {1.0, 0.3}, share);
        ASSERT_TRUE(pose.has_value());
        const ShapeOracle oracle_b(b, *pose);
        const double smaller = std::min(area(oracle_a), area(oracle_b));
        EXPECT_NEAR(overlap(oracle_a, oracle_b).area, share * smaller, 1e-5 * smaller);
    }
}

}  // namespace
}  // namespace nearfield::oracle
