#include <engine/geometry/segment.hpp>
#include <nearfield/curve.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/curve_formulas.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace nearfield {
namespace {

using geometry::nearest_on_segment;
using geometry::to_public;
using geometry::to_vector;
using geometry::Vector;
using std::numbers::pi;
using test::cubic;
using test::ellipse;
using test::Formula;
using test::quadratic;
using test::svg_arc;

using Line = std::vector<Vector>;

double distance_to(const Vector& point, const Line& line) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        best = std::min(best, nearest_on_segment(point, line[i], line[i + 1]).squared_distance);
    }
    return std::sqrt(best);
}

Line closed(const Ring& ring) {
    Line line;
    for (const Vector2& vertex : ring) {
        line.push_back(to_vector(vertex));
    }
    line.push_back(line.front());
    return line;
}

/// Samples of all pieces, closed.
Line dense(const std::vector<Formula>& pieces, std::size_t samples) {
    Line line;
    for (const Formula& piece : pieces) {
        for (std::size_t i = 0; i < samples; ++i) {
            line.push_back(piece(static_cast<double>(i) / static_cast<double>(samples)));
        }
        line.push_back(piece(1.0));
    }
    line.push_back(line.front());
    return line;
}

bool inside(const Vector& p, const Line& line) {
    bool inside = false;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vector& a = line[i];
        const Vector& b = line[i + 1];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (b.x() - a.x()) * ((p.y() - a.y()) / (b.y() - a.y()))) {
            inside = !inside;
        }
    }
    return inside;
}

/// One contour from the builder, and the same from formulas.
struct Curve {
    std::string name;
    CurvePath path;
    std::vector<Formula> pieces;
    double rounding = 0.0;  ///< for the formulas
};

/// Checks that the curves are near each other both ways, and that points away from them have not
/// changed sides.
void check(const Curve& curve, double deviation) {
    SCOPED_TRACE(curve.name + ", deviation " + std::to_string(deviation));
    const auto rings = tessellate(curve.path, deviation);
    ASSERT_TRUE(rings.has_value()) << rings.error().text();
    ASSERT_EQ(rings->size(), 1U);
    const Line ring = closed(rings->front());
    const std::size_t samples = std::max<std::size_t>(64, 24 * ring.size() / curve.pieces.size());
    const Line line = dense(curve.pieces, samples);
    // The samples themselves are joined by chords: 24 times as many, so with at most 1/576 of the
    // deviation, or a little more if the division is uneven.
    const double limit = deviation + curve.rounding;
    double worst = 0.0;
    for (const Vector& point : line) {
        worst = std::max(worst, distance_to(point, ring));
    }
    EXPECT_LE(worst, limit) << "a point of the curve is too far from the ring";
    worst = 0.0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
        for (const double t : {0.0, 0.2, 0.4, 0.5, 0.6, 0.8}) {
            worst = std::max(worst, distance_to(ring[i] + t * (ring[i + 1] - ring[i]), line));
        }
    }
    EXPECT_LE(worst, limit + deviation / 50.0) << "a point of the ring is too far from the curve";

    geometry::Box box;
    for (const Vector& point : line) {
        box.extend(point);
    }
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const Vector point =
            box.min() + Vector(part(random), part(random)).cwiseProduct(box.sizes());
        if (distance_to(point, ring) > limit) {
            EXPECT_EQ(inside(point, ring), inside(point, line));
        }
    }
}

std::vector<Curve> degenerate_curves() {
    std::vector<Curve> curves;
    const auto add_cubic = [&](const char* name, Vector p, Vector q, Vector r, Vector s) {
        CurvePath path;
        path.move_to(to_public(p)).cubic_to(to_public(q), to_public(r), to_public(s)).close();
        curves.push_back({name, path, {cubic(p, q, r, s)}, 0.0});
    };
    add_cubic("plain cubic", {0, 0}, {1, 2}, {3, 2}, {4, 0});
    add_cubic("s-shaped cubic", {0, 0}, {2, 3}, {2, -3}, {4, 0});
    add_cubic("loop", {0, 0}, {6, 4}, {-2, 4}, {4, 0});
    add_cubic("cusp", {0, 0}, {4, 4}, {0, 4}, {4, 0});
    add_cubic("end to end closed", {0, 0}, {5, 4}, {-5, 4}, {0, 0});
    add_cubic("both inner points at the start", {0, 0}, {0, 0}, {0, 0}, {4, 1});
    add_cubic("hairpin beyond its ends", {0, 0}, {9, 0.1}, {-5, 0.1}, {4, 0});
    add_cubic("on one line, back and forth", {0, 0}, {9, 0}, {-5, 0}, {4, 0});
    add_cubic("zero length with handles out and back", {1, 1}, {3, 2}, {3, 2}, {1, 1});
    add_cubic("at a million", {1e6, -1e6}, {1e6 + 1, -1e6 + 3}, {1e6 + 3, -1e6 + 3},
              {1e6 + 4, -1e6});
    curves.back().rounding = 1e-9;
    {
        CurvePath path;
        path.move_to({0, 0}).quadratic_to({1, 5}, {4, 1}).quadratic_to({4, 1}, {0, 0});
        curves.push_back({"quadratics, one of them straight",
                          path,
                          {quadratic({0, 0}, {1, 5}, {4, 1}), quadratic({4, 1}, {4, 1}, {0, 0})},
                          1e-15});
    }
    const auto add_ellipse = [&](const char* name, Vector c, double rx, double ry, double turn,
                                 double rounding) {
        CurvePath path;
        path.ellipse(to_public(c), rx, ry, turn);
        curves.push_back({name, path, {ellipse(c, rx, ry, turn, 0.0, 2.0 * pi)}, rounding});
    };
    add_ellipse("circle", {1, 2}, 3, 3, 0, 1e-14);
    add_ellipse("ellipse", {1, 2}, 5, 1, 0.3, 1e-14);
    add_ellipse("needle", {0, 0}, 5, 1e-4, 1.1, 1e-14);
    add_ellipse("flat ellipse", {0, 0}, 5, 0, 2.0, 1e-14);
    add_ellipse("ellipse at a million", {1e6, 1e6}, 2, 3, 0.5, 1e-9);
    {
        const double radius = 1e9;
        CurvePath path;
        path.move_to({0, 0}).arc_to({radius, radius, 0, false, true}, {4e3, 0}).line_to({0, 4e3});
        const double half = std::asin(2e3 / radius);
        // Relative to the chord, so that nothing cancels for a distant centre.
        const Formula arc = [=](double t) -> Vector {
            const double s = half * (2.0 * t - 1.0);
            return {2e3 + radius * std::sin(s),
                    -2.0 * radius * std::sin(0.5 * (half + s)) * std::sin(0.5 * (half - s))};
        };
        curves.push_back({"short arc of a huge circle",
                          path,
                          {arc, quadratic({4e3, 0}, {2e3, 2e3}, {0, 4e3})},
                          1e-9});
    }
    return curves;
}

TEST(Tessellate, DegenerateCurvesStayWithinTheDeviation) {
    for (const Curve& curve : degenerate_curves()) {
        for (const double deviation : {3.0, 0.1, 2e-3}) {
            check(curve, deviation);
        }
    }
}

TEST(Tessellate, RandomCubicsStayWithinTheDeviation) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> anywhere(-10.0, 10.0);
        const auto point = [&]() -> Vector { return {anywhere(random), anywhere(random)}; };
        const Vector p = point(), q = point(), r = point(), s = point(), u = point();
        CurvePath path;
        path.move_to(to_public(p))
            .cubic_to(to_public(q), to_public(r), to_public(s))
            .quadratic_to(to_public(u), to_public(p));
        check(
            {"seed " + std::to_string(seed), path, {cubic(p, q, r, s), quadratic(s, u, p)}, 1e-14},
            std::pow(10.0, anywhere(random) / 10.0 - 1.5));
    }
}

TEST(Tessellate, ArcsOfAllFlagsAndRadiiAreThoseOfSvg) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> anywhere(-5.0, 5.0);
        const Vector from(anywhere(random), anywhere(random));
        const Vector to(anywhere(random), anywhere(random));
        // One in three is too small to reach and must be scaled up.
        const double size = seed % 3 == 0 ? 0.1 : 8.0;
        EllipticArc arc{size * (0.3 + std::abs(anywhere(random))),
                        -size * (0.3 + std::abs(anywhere(random))), anywhere(random), false, false};
        for (const bool large : {false, true}) {
            for (const bool left : {false, true}) {
                arc.large = large;
                arc.counter_clockwise = left;
                CurvePath path;
                path.move_to(to_public(from)).arc_to(arc, to_public(to));
                // The centre of an arc that just reaches is the root of a small difference.
                check({"seed " + std::to_string(seed) + (large ? " large" : "") +
                           (left ? " left" : ""),
                       path,
                       {svg_arc(from, to, arc)},
                       1e-6},
                      0.02);
            }
        }
    }
}

TEST(Tessellate, CentreArcsTurnBothWays) {
    for (const double sweep : {0.1, 1.5, pi, 5.0, 2.0 * pi}) {
        for (const double sign : {1.0, -1.0}) {
            CurvePath path;
            path.move_to({3, 1}).arc_about({1, 1}, sign * sweep);
            check({"sweep " + std::to_string(sign * sweep),
                   path,
                   {ellipse({1, 1}, 2, 2, 0, 0, sign * sweep)},
                   1e-14},
                  1e-3);
        }
    }
}

TEST(Tessellate, SplinesPassThroughTheirPointsSmoothly) {
    const std::vector<Vector2> points{{0, 0}, {4, 0}, {4, 0}, {4.5, 0.1}, {5, 6}, {-1, 3}, {0, 0}};
    CurvePath path;
    path.catmull_rom(points);
    const auto rings = tessellate(path, 1e-3);
    ASSERT_TRUE(rings.has_value()) << rings.error().text();
    const Line ring = closed(rings->front());
    for (const Vector2& point : points) {
        EXPECT_EQ(distance_to(to_vector(point), ring), 0.0);
    }
    // No corners: neighbouring edges of such a fine ring turn little.
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
        const Vector before = ring[i] - ring[i == 0 ? ring.size() - 2 : i - 1];
        const Vector after = ring[i + 1] - ring[i];
        EXPECT_GT(before.normalized().dot(after.normalized()), 0.9) << i;
    }
    // The spline equals its definition by repeated interpolation (Barry and Goldman).
    const std::vector<Vector> p{{-1, 3}, {0, 0}, {4, 0}, {4.5, 0.1}};
    std::vector<double> knot{0.0};
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        knot.push_back(knot.back() + std::sqrt((p[i + 1] - p[i]).norm()));
    }
    const auto mix = [&](const Vector& a, const Vector& b, double t, std::size_t i,
                         std::size_t j) -> Vector {
        return (knot[j] - t) / (knot[j] - knot[i]) * a + (t - knot[i]) / (knot[j] - knot[i]) * b;
    };
    for (int step = 1; step < 10; ++step) {
        const double t = knot[1] + (knot[2] - knot[1]) * step / 10.0;
        const Vector a = mix(p[0], p[1], t, 0, 1), b = mix(p[1], p[2], t, 1, 2),
                     c = mix(p[2], p[3], t, 2, 3);
        const Vector on = mix(mix(a, b, t, 0, 2), mix(b, c, t, 1, 3), t, 1, 2);
        EXPECT_LE(distance_to(on, ring), 1e-3) << step;
    }
}

/// The minimum number of chords between points of the curve within the deviation: each is as long
/// as possible.
std::size_t fewest_chords(const Formula& formula, double deviation) {
    constexpr std::size_t samples = 6000;
    Line line;
    for (std::size_t i = 0; i <= samples; ++i) {
        line.push_back(formula(static_cast<double>(i) / samples));
    }
    const auto fits = [&](std::size_t from, std::size_t to) {
        const std::size_t step = std::max<std::size_t>(1, (to - from) / 64);
        for (std::size_t i = from; i < to; i += step) {
            if (nearest_on_segment(line[i], line[from], line[to]).squared_distance >
                deviation * deviation) {
                return false;
            }
        }
        return true;
    };
    std::size_t chords = 0;
    for (std::size_t from = 0; from < samples; ++chords) {
        std::size_t to = from + 1;
        while (to < samples && fits(from, to + 1)) {
            ++to;
        }
        from = to;
    }
    return chords;
}

TEST(Tessellate, SegmentsAreFew) {
    for (const Curve& curve : degenerate_curves()) {
        if (curve.pieces.size() != 1) {
            continue;
        }
        const double deviation = 1e-3;
        const std::size_t fewest = fewest_chords(curve.pieces.front(), deviation);
        const auto rings = tessellate(curve.path, deviation);
        ASSERT_TRUE(rings.has_value());
        // Where a curve turns back, bisection approaches the turn in a few short pieces.
        EXPECT_LE(rings->front().size(), 2 * fewest + 12) << curve.name << ": fewest " << fewest;
    }
    for (const double deviation : {0.5, 1e-2, 1e-5}) {
        CurvePath path;
        path.circle({0, 0}, 2.0);
        const auto rings = tessellate(path, deviation);
        ASSERT_TRUE(rings.has_value());
        const double needed = std::ceil(pi / std::acos(1.0 - deviation / 2.0));
        EXPECT_NEAR(static_cast<double>(rings->front().size()), needed, 1.0) << deviation;
    }
}

TEST(Tessellate, TurningAndMovingAPathTurnsAndMovesItsRings) {
    const double angle = 0.7;
    const AffineMap map{
        {std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}, {30, -20}};
    for (const Curve& curve : degenerate_curves()) {
        const auto still = tessellate(curve.path, 0.01);
        CurvePath moved = curve.path;
        moved.transform(map);
        const auto rings = tessellate(moved, 0.01);
        ASSERT_TRUE(still.has_value() && rings.has_value());
        if (curve.rounding > 1e-10 || curve.name.find("line") != std::string::npos ||
            curve.name.find("flat") != std::string::npos ||
            curve.name.find("zero") != std::string::npos) {
            continue;  // on the edge between two bounds, where rounding may decide
        }
        ASSERT_EQ(still->front().size(), rings->front().size()) << curve.name;
        for (std::size_t i = 0; i < rings->front().size(); ++i) {
            const Vector2 v = still->front()[i];
            const Vector expected =
                v.x * to_vector(map.x_axis) + v.y * to_vector(map.y_axis) + to_vector(map.origin);
            EXPECT_LE((to_vector(rings->front()[i]) - expected).norm(), 1e-12) << curve.name;
        }
    }
}

TEST(Tessellate, StraightOutlinesStayAsTheyAre) {
    CurvePath path;
    path.move_to({0, 0}).line_to({4, 0}).line_to({4, 4}).line_to({0, 0}).close();
    path.line_to({1, 1}).line_to({2, 5});  // starts where the closed contour started
    path.move_to({9, 9});                  // draws nothing
    const auto rings = tessellate(path, 1.0);
    ASSERT_TRUE(rings.has_value());
    EXPECT_EQ(*rings, (std::vector<Ring>{{{0, 0}, {4, 0}, {4, 4}}, {{0, 0}, {1, 1}, {2, 5}}}));
}

TEST(Tessellate, ThinCurvesKeepAnInside) {
    CurvePath path;
    path.move_to({0, 0}).quadratic_to({1, 0.01}, {2, 0}).close();
    const auto rings = tessellate(path, 1.0);
    ASSERT_TRUE(rings.has_value());
    EXPECT_GE(rings->front().size(), 3U);
}

std::string refusal(const CurvePath& path, double deviation, std::uint32_t most = max_vertices) {
    const auto rings = tessellate(path, deviation, most);
    return rings.has_value()
               ? "ok"
               : std::string(to_string(rings.error().code())) + ": " + rings.error().message();
}

TEST(Tessellate, RefusesByName) {
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal({}, 0.1), "invalid_shape: the path has no contour");
    EXPECT_EQ(
        refusal(CurvePath().line_to({1, 1}), 0.1),
        "invalid_shape: contour 0, line_to: no point to begin at; a contour begins with move_to");
    EXPECT_EQ(
        refusal(CurvePath().arc_about({1, 1}, 1.0), 0.1),
        "invalid_shape: contour 0, arc_about: no point to begin at; a contour begins with move_to");
    EXPECT_EQ(refusal(CurvePath().circle({0, 0}, not_a_number), 0.1),
              "invalid_shape: contour 0, ellipse: a radius or the rotation is not a finite number");
    EXPECT_EQ(
        refusal(CurvePath().circle({0, 0}, 1).circle({0, not_a_number}, 1), 0.1),
        "invalid_shape: contour 1, start: a number is not finite, or its magnitude exceeds 1e+12");
    EXPECT_EQ(refusal(CurvePath().move_to({0, 0}).cubic_to({1, 1}, {2e12, 0}, {1, 0}), 0.1),
              "invalid_shape: contour 0, segment 0: a number is not finite, or its magnitude "
              "exceeds 1e+12");
    EXPECT_EQ(
        refusal(CurvePath().move_to({0, 0}).arc_about({1, 0}, 7.0), 0.1),
        "invalid_shape: contour 0, arc_about: the sweep is not a number of at most a whole turn");
    const std::vector<Vector2> two{{0, 0}, {1, 0}, {1, 0}, {0, 0}};
    EXPECT_EQ(refusal(CurvePath().catmull_rom(two), 0.1),
              "invalid_shape: contour 0, catmull_rom: a closed spline needs three points");
    const CurvePath circle = CurvePath().circle({1e6, 0}, 1);
    for (const double deviation : {0.0, -1.0, not_a_number, 1e300}) {
        EXPECT_NE(refusal(circle, deviation).find("invalid_shape: the deviation is "),
                  std::string::npos);
    }
    EXPECT_NE(refusal(circle, 1e-8).find("below what double precision resolves"),
              std::string::npos);
    EXPECT_EQ(refusal(circle, 1e-4, 100),
              "too_large: the tessellated shape needs more than 100 vertices, the limit; allow "
              "more deviation");
    const CurvePath needle = CurvePath().ellipse({0, 0}, 1, 0.5);
    const auto rings = tessellate(needle, 1e-3);
    ASSERT_TRUE(rings.has_value());
    const auto size = static_cast<std::uint32_t>(rings->front().size());
    EXPECT_EQ(refusal(needle, 1e-3, size + 1), "ok");
    EXPECT_EQ(refusal(needle, 1e-3, size - 1).rfind("too_large", 0), 0U);
}

}  // namespace
}  // namespace nearfield
