#include "cli_test.hpp"
#include "contract.hpp"
#include "rectangle_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>

namespace nearfield::test {
namespace {

constexpr double rounding = 1e-9;

/// Formats a number for the command line without loss.
std::string text(double number) {
    std::ostringstream stream;
    stream.precision(17);
    stream << number;
    return stream.str();
}

std::string pose(Point translation, double degrees = 0.0) {
    return text(translation.x) + "," + text(translation.y) + "," + text(degrees);
}

/// The maximum depth of one unit square's boundary inside another one moved by (u, v).
double deepest_of_squares(double u, double v) {
    u = std::abs(u);
    v = std::abs(v);
    const auto edge = [](double across, double along) {
        return std::min({1.0 - across, across, 1.0 - along, 0.5});
    };
    return std::max(edge(u, v), edge(v, u));
}

/// Checks one record against the closed form for squares; returns its point.
Point expect_exact_record(const Json& record, const Rectangle& a, const Rectangle& b,
                          double tolerance) {
    const Point point = to_point(record.at("point"));
    const Point nearest = to_point(record.at("nearest"));
    const Point direction = to_point(record.at("direction"));
    const double depth = record.at("depth").get<double>();
    EXPECT_NEAR(a.signed_distance(point), 0.0, rounding) << record;
    EXPECT_NEAR(b.signed_distance(nearest), 0.0, rounding) << record;
    EXPECT_GT(depth, 0.0) << record;
    EXPECT_NEAR(depth, -b.signed_distance(point), rounding) << record;
    EXPECT_NEAR(point.x + depth * direction.x, nearest.x, rounding) << record;
    EXPECT_NEAR(point.y + depth * direction.y, nearest.y, rounding) << record;
    EXPECT_NEAR(std::hypot(direction.x, direction.y), 1.0, rounding) << record;

    std::array<double, 4> depths = b.depth_below_edges(point);
    EXPECT_EQ(record.at("feature").size(), 1U) << record;
    EXPECT_NEAR(depths.at(record.at("feature").at("edge").get<std::size_t>()), depth, rounding)
        << record;
    std::sort(depths.begin(), depths.end());
    if (depths[1] - depths[0] > tolerance) {
        EXPECT_EQ(record.at("unique"), true) << record;
    } else if (depths[1] - depths[0] < rounding && depth > tolerance) {
        EXPECT_EQ(record.at("unique"), false) << record;
    }
    return point;
}

void expect_no_wide_gap(const std::vector<Point>& points, const Rectangle& a, const Rectangle& b,
                        double tolerance) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (int step = 0; step < 500; ++step) {
            const Point p = a.on_edge(edge, step / 500.0);
            const double depth = -b.signed_distance(p);
            if (depth < 0.01 * tolerance) {
                continue;
            }
            double gap = INFINITY;
            for (const Point& point : points) {
                gap = std::min(gap, distance(p, point));
            }
            // Away from A's entry into B there is a sample on either side.
            const double widest = depth > 2.0 * tolerance ? tolerance : 2.0 * tolerance;
            EXPECT_LE(gap, widest + rounding) << "near " << p.x << ", " << p.y;
        }
    }
}

class SquaresOverlap : public CliTest, public testing::WithParamInterface<Point> {};

TEST_P(SquaresOverlap, BoundaryPointsAreAsDeepAsSquaresSay) {
    const Rectangle a = unit_square_at({0, 0});
    const Rectangle b = unit_square_at(GetParam());
    const double d = 0.03;
    const Json json =
        answer(squares("penetration") + Arguments{"-d", text(d), "--pose-b", pose(GetParam())});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "penetration", d, d * std::numbers::sqrt2);
    EXPECT_EQ(json.at("intersects"), true);

    std::vector<Point> points;
    double deepest = 0.0;
    for (const Json& record : json.at("records")) {
        points.push_back(expect_exact_record(record, a, b, d));
        deepest = std::max(deepest, record.at("depth").get<double>());
    }
    EXPECT_EQ(json.at("count").get<std::size_t>(), points.size());
    expect_no_wide_gap(points, a, b, d);
    EXPECT_EQ(json.at("deepest").at("depth").get<double>(), deepest);
    EXPECT_NEAR(-b.signed_distance(to_point(json.at("deepest").at("point"))), deepest, rounding);
    const double truth = deepest_of_squares(GetParam().x, GetParam().y);
    EXPECT_LE(deepest, truth + rounding);
    EXPECT_GE(deepest, truth - json.at("error_bound").get<double>());
}

TEST_P(SquaresOverlap, TheOneVertexInsideIsAsDeepAsSquaresSay) {
    const Rectangle a = unit_square_at({0, 0});
    const Rectangle b = unit_square_at(GetParam());
    const double d = 0.03;
    const Json json =
        answer(squares("penetration") +
               Arguments{"-d", text(d), "--points", "vertices", "--pose-b", pose(GetParam())});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "penetration", d, d * std::numbers::sqrt2);
    EXPECT_EQ(json.at("count"), 1);
    ASSERT_EQ(json.at("records").size(), 1U);
    const Json& record = json.at("records").front();
    const Point point = expect_exact_record(record, a, b, d);
    EXPECT_EQ(point.x, GetParam().x > 0.0 ? 1.0 : 0.0);
    EXPECT_EQ(point.y, GetParam().y > 0.0 ? 1.0 : 0.0);
    for (const auto& key : {"point", "depth", "direction"}) {
        EXPECT_EQ(json.at("deepest").at(key), record.at(key)) << key;
    }
}

INSTANTIATE_TEST_SUITE_P(ByKnownAmounts, SquaresOverlap,
                         testing::Values(Point{0.6, 0.3}, Point{-0.25, 0.55}, Point{0.5, -0.5},
                                         Point{-0.93, -0.01}));

class Penetration : public CliTest {};

TEST_F(Penetration, TouchingSquaresIntersectButDoNotPenetrate) {
    const Json json =
        answer(squares("penetration") + Arguments{"-d", "0.05", "--pose-b", "1,0.25,0"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), true);
    EXPECT_EQ(json.at("count"), 0);
    EXPECT_TRUE(json.at("records").empty());
    EXPECT_TRUE(json.at("deepest").is_null());
}

TEST_F(Penetration, SquaresApartHaveNothingInCommon) {
    const Json json =
        answer(squares("penetration") + Arguments{"-d", "0.05", "--pose-b", "1.001,0.25,0"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), false);
    EXPECT_EQ(json.at("count"), 0);
    EXPECT_TRUE(json.at("records").empty());
    EXPECT_TRUE(json.at("regions").empty());
}

TEST_F(Penetration, TellsItsTilesOnRequest) {
    const Arguments query =
        squares("penetration", "raster") + Arguments{"-d", "0.002", "--pose-b", "0.6,0.3,0"};
    EXPECT_FALSE(answer(query).contains("tiles"));
    const Json json = answer(query + Arguments{"--tiles"});
    ASSERT_TRUE(json.is_object());
    ASSERT_GT(json.at("tiles").size(), 1U);
    const Json& region = json.at("regions").at(0);
    for (const Json& tile : json.at("tiles")) {
        EXPECT_EQ(tile.at("technique"), "raster");
        EXPECT_EQ(tile.at("side"), "a");
        EXPECT_EQ(tile.at("tile_batch"), 0);
        for (const std::size_t axis : {0U, 1U}) {
            EXPECT_GE(tile.at("min").at(axis).get<double>(),
                      region.at("min").at(axis).get<double>() - 1e-9);
            EXPECT_LE(tile.at("max").at(axis).get<double>(),
                      region.at("max").at(axis).get<double>() + 1e-9);
        }
    }
    EXPECT_TRUE(answer(squares("penetration", "cpu") + Arguments{"-d", "0.05", "--tiles"})
                    .at("tiles")
                    .empty());
}

TEST_F(Penetration, AllVerticesOfAContainedShapePenetrate) {
    const std::string large = folder_.write("large.wkt", "POLYGON ((-1 -2, 5 -2, 5 6, -1 6))");
    const Json json =
        answer({"query", "penetration", a_, large, "-d", "0.1", "--points", "vertices"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), true);
    ASSERT_EQ(json.at("count"), 4);
    const std::array<double, 4> depths{1.0, 2.0, 2.0, 1.0};
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
        EXPECT_NEAR(json.at("records").at(vertex).at("depth").get<double>(), depths[vertex],
                    rounding);
    }
}

/// Rotated by 90 degrees counter-clockwise about its origin, the square is to the left of it.
TEST_F(Penetration, PosesTurnCounterClockwiseInDegreesBeforeTheyMove) {
    const Json json =
        answer(squares("penetration") +
               Arguments{"-d", "0.05", "--points", "vertices", "--pose-b", "1.6,0.3,90"});
    ASSERT_TRUE(json.is_object());
    ASSERT_EQ(json.at("count"), 1);
    EXPECT_NEAR(json.at("deepest").at("depth").get<double>(), 0.3, rounding);
    EXPECT_NEAR(json.at("deepest").at("direction").at(1).get<double>(), 1.0, rounding);
    EXPECT_EQ(json.at("records").front().at("feature").at("edge"), 1);
}

TEST_F(Penetration, MovingBothShapesTogetherMovesTheAnswer) {
    const Json still =
        answer(squares("penetration") + Arguments{"-d", "0.05", "--pose-b", "0.6,0.3,0"});
    // 30 degrees about the origin, then by (1e6, -1e6).
    const double cosine = std::cos(std::numbers::pi / 6);
    const double sine = 0.5;
    const Point b{1e6 + cosine * 0.6 - sine * 0.3, -1e6 + sine * 0.6 + cosine * 0.3};
    const Json moved =
        answer(squares("penetration") +
               Arguments{"-d", "0.05", "--pose-a", "1e6,-1e6,30", "--pose-b", pose(b, 30)});
    ASSERT_TRUE(still.is_object() && moved.is_object());
    ASSERT_EQ(still.at("count"), moved.at("count"));
    const double far_rounding = 1e-8;  // coordinates of 1e6 have a precision of only 1e-10
    for (std::size_t index = 0; index < still.at("records").size(); ++index) {
        const Json& before = still.at("records").at(index);
        const Json& after = moved.at("records").at(index);
        const Point p = to_point(before.at("point"));
        const Point turned{1e6 + cosine * p.x - sine * p.y, -1e6 + sine * p.x + cosine * p.y};
        EXPECT_LE(distance(turned, to_point(after.at("point"))), far_rounding) << after;
        EXPECT_NEAR(before.at("depth").get<double>(), after.at("depth").get<double>(),
                    far_rounding);
    }
}

}  // namespace
}  // namespace nearfield::test
