#include "dxf_text.hpp"

#include <nearfield/curve.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

double distance_to(const Vector2& p, const Vector2& a, const Vector2& b) {
    const Vector2 way{b.x - a.x, b.y - a.y};
    const double squared = way.x * way.x + way.y * way.y;
    const double along =
        squared > 0.0 ? ((p.x - a.x) * way.x + (p.y - a.y) * way.y) / squared : 0.0;
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(a.x + t * way.x - p.x, a.y + t * way.y - p.y);
}

/// From a point to the rings.
double distance_to(const Vector2& point, const std::vector<Ring>& rings) {
    double least = std::numeric_limits<double>::infinity();
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            least = std::min(least, distance_to(point, ring[i], ring[(i + 1) % ring.size()]));
        }
    }
    return least;
}

/// Of each vertex from a polyline.
double largest_distance(const std::vector<Ring>& rings, const std::vector<Vector2>& polyline) {
    double largest = 0.0;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
                least = std::min(least, distance_to(vertex, polyline[i], polyline[i + 1]));
            }
            largest = std::max(largest, least);
        }
    }
    return largest;
}

/// The path is a single contour: this polyline, and a line from its end to its start.
void expect_along(const CurvePath& path, std::vector<Vector2> polyline) {
    constexpr double deviation = 1e-4;
    const auto rings = tessellate(path, deviation);
    ASSERT_TRUE(rings.has_value()) << rings.error().message();
    ASSERT_EQ(rings->size(), 1U);
    for (std::size_t i = 0; i < polyline.size(); i += 3) {
        ASSERT_LE(distance_to(polyline[i], *rings), 1.01 * deviation);
    }
    polyline.push_back(polyline.front());
    ASSERT_LE(largest_distance(*rings, polyline), deviation);
}

std::string text_of(double number) {
    std::ostringstream text;
    text.precision(17);
    text << number;
    return text.str();
}

struct Spline {
    int degree = 3;
    std::vector<double> knots;
    std::vector<Vector2> points;

    [[nodiscard]] std::string text() const {
        std::string text = " 0 SPLINE 8 0 210 0 220 0 230 1 70 8 71 " + std::to_string(degree);
        for (const double knot : knots) {
            text += " 40 " + text_of(knot);
        }
        for (const Vector2& point : points) {
            text += " 10 " + text_of(point.x) + " 20 " + text_of(point.y) + " 30 0";
        }
        return text;
    }
    /// The basis functions as Cox and de Boor define them, added up.
    [[nodiscard]] Vector2 at(double t) const {
        const auto last = points.size();
        std::size_t span = static_cast<std::size_t>(degree);
        while (span + 1 < last && !(t < knots[span + 1])) {
            ++span;
        }
        while (knots[span] == knots[span + 1]) {
            --span;
        }
        std::vector<double> basis(knots.size() - 1, 0.0);
        basis[span] = 1.0;
        for (std::size_t p = 1; p <= static_cast<std::size_t>(degree); ++p) {
            for (std::size_t i = 0; i + p + 1 < knots.size(); ++i) {
                const double left = knots[i + p] - knots[i];
                const double right = knots[i + p + 1] - knots[i + 1];
                basis[i] = (left > 0.0 ? (t - knots[i]) / left * basis[i] : 0.0) +
                           (right > 0.0 ? (knots[i + p + 1] - t) / right * basis[i + 1] : 0.0);
            }
        }
        Vector2 sum;
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum.x += basis[i] * points[i].x;
            sum.y += basis[i] * points[i].y;
        }
        return sum;
    }
    /// With every knot, where there may be corners.
    [[nodiscard]] std::vector<Vector2> polyline(int per_span) const {
        std::vector<Vector2> line{at(knots[static_cast<std::size_t>(degree)])};
        for (std::size_t i = static_cast<std::size_t>(degree); i < points.size(); ++i) {
            for (int k = 1; k <= per_span && knots[i] < knots[i + 1]; ++k) {
                line.push_back(at(k == per_span
                                      ? knots[i + 1]
                                      : knots[i] + (knots[i + 1] - knots[i]) * k / per_span));
            }
        }
        return line;
    }
};

/// `is_clamped`: it begins and ends at its first and last point.
Spline any_spline(std::mt19937& random, bool is_clamped) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Spline spline{.degree = 1 + static_cast<int>(random() % 3), .knots = {}, .points = {}};
    const auto count = static_cast<std::size_t>(spline.degree) + 1 + random() % 8;
    for (std::size_t i = 0; i < count; ++i) {
        spline.points.push_back({between(-5.0, 5.0), between(-5.0, 5.0)});
    }
    const std::size_t ends = static_cast<std::size_t>(spline.degree) + 1;
    double knot = between(-3.0, 3.0);
    std::size_t repeated = 1;
    for (std::size_t i = 0; i < count + ends; ++i) {
        const bool stays = is_clamped ? i > 0 && (i < ends || i > count)
                                      : i > 0 && random() % 4 == 0 && repeated < ends - 1;
        repeated = stays ? repeated + 1 : 1;
        knot += stays ? 0.0 : between(0.1, 2.0);
        spline.knots.push_back(knot);
    }
    return spline;
}

TEST(ToolsDxfSplines, AreTheirBasisFunctions) {
    for (unsigned seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Spline spline = any_spline(random, seed % 2 == 0);
        const std::vector<Vector2> truth = spline.polyline(300);
        if (truth.size() == 1 || (spline.degree == 1 && truth.size() == 301)) {
            continue;  // nothing, or a line
        }
        const std::string closing = line(truth.back(), truth.front());
        // The other end first.
        const CurvePath path = read_drawing(
            drawing(seed % 3 == 0 ? closing + spline.text() : spline.text() + closing));
        ASSERT_NO_FATAL_FAILURE(expect_along(path, truth));
    }
}

/// Of knots at equal distances, whose last points are the first ones again.
TEST(ToolsDxfSplines, CloseByThemselves) {
    for (int degree = 2; degree <= 3; ++degree) {
        Spline spline{.degree = degree, .knots = {}, .points = {}};
        const int different = 7;
        for (int i = 0; i < different + degree; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i % different) / different;
            spline.points.push_back({10.0 + 3.0 * std::cos(angle), 2.0 * std::sin(angle)});
        }
        for (int i = 0; i < different + 2 * degree + 1; ++i) {
            spline.knots.push_back(i);
        }
        const auto rings = *tessellate(read_drawing(drawing(spline.text())), 1e-5);
        ASSERT_EQ(rings.size(), 1U);
        EXPECT_LE(largest_distance(rings, spline.polyline(500)), 1e-5);
        EXPECT_GT(rings[0].size(), 20U);
    }
}

TEST(ToolsDxfSplines, OfOtherKindsAreRefusedByName) {
    Spline spline{.degree = 2, .knots = {0, 0, 0, 1, 1, 1}, .points = {{0, 0}, {1, 2}, {2, 0}}};
    const auto expect = [&](const std::string& text, const std::string& why) {
        const std::string said = refusal(drawing(text));
        EXPECT_EQ(said.find("a.dxf:6:1: SPLINE: " + why), 0U) << said;
    };
    const std::string good = spline.text();
    EXPECT_EQ(refusal(drawing(good + line({2, 0}, {0, 0}))), "no error");
    EXPECT_EQ(refusal(drawing(good + " 41 1 41 1 41 1" + line({2, 0}, {0, 0}))), "no error");
    expect(good + " 41 1 41 0.7 41 1", "is rational");
    expect(good + " 30 1", "does not lie in the plane");
    expect(" 0 SPLINE 70 8 71 3 11 0 21 0 11 1 21 1", "has points to go through");
    expect(" 0 SPLINE 71 4" + good.substr(9), "is not of degree 1, 2 or 3");
    expect(" 0 SPLINE 71 2.5" + good.substr(9), "is not of degree 1, 2 or 3");
    expect(good + " 40 2", "has 3 control points and 7 knots; degree 2 needs");
    spline.knots = {0, 0, 0, 1, 1, 0.5};
    expect(spline.text(), "its knots do not ascend");
    spline.knots = {0, 0, 0, 1, 1, 1, 2, 2, 2};
    spline.points.insert(spline.points.end(), {{5, 5}, {6, 6}, {7, 5}});
    expect(spline.text(), "is in several pieces");
    // All knots in one place: nothing is drawn.
    spline.knots.assign(9, 1.0);
    EXPECT_NE(refusal(drawing(spline.text())).find("has no outline"), std::string::npos);
}

TEST(ToolsDxfEllipses, MayBeArcs) {
    for (unsigned seed = 0; seed < 80; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const Vector2 centre{between(-5.0, 5.0), between(-5.0, 5.0)};
        const Vector2 axis{between(-4.0, 4.0), between(-4.0, 4.0)};
        const double ratio = between(0.1, 1.0);
        const double first = between(0.0, 2.0 * std::numbers::pi);
        const double sweep =
            seed % 5 == 0 ? std::numbers::pi : between(0.05, 2.0 * std::numbers::pi - 0.05);
        const double way = seed % 2 == 0 ? 1.0 : -1.0;
        double last = first + sweep;
        last -= seed % 3 == 0 && last > 2.0 * std::numbers::pi ? 2.0 * std::numbers::pi
                                                               : 0.0;  // both are written
        std::vector<Vector2> truth;
        for (int i = 0; i <= 700; ++i) {
            const double angle = first + sweep * i / 700.0;
            const double along = std::cos(angle);
            const double across = way * ratio * std::sin(angle);
            truth.push_back({centre.x + along * axis.x - across * axis.y,
                             centre.y + along * axis.y + across * axis.x});
        }
        const std::string arc = " 0 ELLIPSE 10 " + text_of(centre.x) + " 20 " + text_of(centre.y) +
                                " 11 " + text_of(axis.x) + " 21 " + text_of(axis.y) + " 40 " +
                                text_of(ratio) + " 41 " + text_of(first) + " 42 " + text_of(last) +
                                " 230 " + text_of(way);
        const std::string chord = line(truth.front(), truth.back());
        const CurvePath path = read_drawing(drawing(seed % 7 < 3 ? chord + arc : arc + chord));
        ASSERT_NO_FATAL_FAILURE(expect_along(path, truth));
    }
}

}  // namespace
}  // namespace nearfield::tools
