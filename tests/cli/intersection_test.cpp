#include "cli_test.hpp"
#include "contract.hpp"
#include "rectangle_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nearfield::test {
namespace {

constexpr double rounding = 1e-9;

bool any_within(const std::vector<Point>& points, Point p, double reach) {
    return std::any_of(points.begin(), points.end(),
                       [&](Point q) { return distance(p, q) <= reach + rounding; });
}

/// Unit squares, B moved by (0.6, 0.3): their intersection is a rectangle of 0.4 by 0.7, and their
/// boundaries cross at (1, 0.3) and (0.6, 1).
class Intersection : public CliTest {
protected:
    static constexpr double d = 0.02;

    /// Returns the samples after checking the properties of all kinds.
    std::vector<Point> ask(const std::string& kind) {
        json_ = answer(squares("intersection") +
                       Arguments{"-d", "0.02", "--pose-b", "0.6,0.3,0", "--kind", kind});
        std::vector<Point> points;
        if (!json_.is_object()) {
            return points;
        }
        const double cell = expect_common_part(json_, "intersection", d, 0.0);
        bound_ = json_.at("error_bound").get<double>();
        EXPECT_EQ(json_.at("intersects"), true);
        EXPECT_EQ(json_.at("kind"), kind);
        for (const Json& sample : json_.at("samples")) {
            points.push_back(to_point(sample));
        }
        EXPECT_TRUE(json_.at("count").is_number_unsigned());
        EXPECT_EQ(json_.at("count").get<std::size_t>(), points.size());
        EXPECT_NEAR(json_.at("area").get<double>(), json_.at("count").get<double>() * cell * cell,
                    rounding);
        return points;
    }

    const Rectangle square_a_ = unit_square_at({0, 0});
    const Rectangle square_b_ = unit_square_at({0.6, 0.3});
    Json json_;
    double bound_ = 0.0;
};

TEST_F(Intersection, VolumesFillTheCommonRectangle) {
    const std::vector<Point> samples = ask("volume-volume");
    ASSERT_TRUE(json_.is_object());
    for (const Point& sample : samples) {
        EXPECT_LE(square_a_.outside_by(sample), bound_ + rounding);
        EXPECT_LE(square_b_.outside_by(sample), bound_ + rounding);
    }
    const Rectangle common{square_b_.min, square_a_.max};
    for (double x = common.min.x + bound_; x <= common.max.x - bound_; x += 0.5 * d) {
        for (double y = common.min.y + bound_; y <= common.max.y - bound_; y += 0.5 * d) {
            EXPECT_TRUE(any_within(samples, {x, y}, bound_)) << x << ", " << y;
        }
    }
    const double circumference = 2.0 * (0.4 + 0.7);
    EXPECT_NEAR(json_.at("area").get<double>(), 0.4 * 0.7, circumference * bound_);
}

TEST_F(Intersection, TheBoundaryOfALiesInTheVolumeOfB) {
    const std::vector<Point> samples = ask("boundary-volume");
    ASSERT_TRUE(json_.is_object());
    for (const Point& sample : samples) {
        EXPECT_LE(std::abs(square_a_.signed_distance(sample)), bound_ + rounding);
        EXPECT_LE(square_b_.outside_by(sample), bound_ + rounding);
    }
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (int step = 0; step < 200; ++step) {
            const Point p = square_a_.on_edge(edge, step / 200.0);
            if (square_b_.signed_distance(p) < -bound_) {
                EXPECT_TRUE(any_within(samples, p, bound_)) << p.x << ", " << p.y;
            }
        }
    }
}

TEST_F(Intersection, BoundariesMeetAtTheTwoCrossings) {
    const std::vector<Point> samples = ask("boundary-boundary");
    ASSERT_TRUE(json_.is_object());
    for (const Point& sample : samples) {
        EXPECT_LE(std::abs(square_a_.signed_distance(sample)), bound_ + rounding);
        EXPECT_LE(std::abs(square_b_.signed_distance(sample)), bound_ + rounding);
    }
    EXPECT_TRUE(any_within(samples, {1.0, 0.3}, bound_));
    EXPECT_TRUE(any_within(samples, {0.6, 1.0}, bound_));
}

TEST_F(Intersection, TheKindLeftOutIsVolumeVolume) {
    Json left_out =
        answer(squares("intersection") + Arguments{"-d", "0.02", "--pose-b", "0.6,0.3,0"});
    ask("volume-volume");
    ASSERT_TRUE(left_out.is_object() && json_.is_object());
    left_out.erase("timings_ms");
    json_.erase("timings_ms");
    EXPECT_EQ(left_out, json_);
}

TEST_F(Intersection, EveryStrategyGivesTheSameAnswer) {
    const auto ask_by = [&](const std::string& strategy, const std::string& kind) {
        Json json =
            answer(squares("intersection") + Arguments{"-d", "0.02", "--pose-b", "0.6,0.3,12",
                                                       "--kind", kind, "--strategy", strategy});
        if (json.is_object()) {
            EXPECT_EQ(json.at("strategy"), strategy);
            json.erase("strategy");
            json.erase("timings_ms");
        }
        return json;
    };
    for (const auto& kind : {"boundary-boundary", "boundary-volume", "volume-volume"}) {
        const Json expected = ask_by("stencil", kind);
        ASSERT_TRUE(expected.is_object());
        EXPECT_GT(expected.at("count").get<int>(), 0);
        for (const auto& strategy : {"blend", "logic-op", "depth"}) {
            EXPECT_EQ(ask_by(strategy, kind), expected) << strategy << ", " << kind;
        }
    }
}

TEST_F(Intersection, TheBoxHoldsTheSamplesAndNoMore) {
    const std::vector<Point> samples = ask("boundary-volume");
    ASSERT_FALSE(samples.empty());
    EXPECT_EQ(json_.at("strategy"), "stencil");
    Point low = samples.front();
    Point high = samples.front();
    for (const Point& sample : samples) {
        low = {std::min(low.x, sample.x), std::min(low.y, sample.y)};
        high = {std::max(high.x, sample.x), std::max(high.y, sample.y)};
    }
    EXPECT_EQ(json_.at("box").at("min"), Json::array({low.x, low.y}));
    EXPECT_EQ(json_.at("box").at("max"), Json::array({high.x, high.y}));
}

TEST_F(Intersection, AShapeInAHoleDoesNotIntersect) {
    const std::string frame = folder_.write(
        "frame.wkt", "POLYGON ((-2 -2, 4 -2, 4 4, -2 4, -2 -2), (-1 -1, 3 -1, 3 3, -1 3, -1 -1))");
    const Json json = answer({"query", "intersection", a_, frame, "-d", "0.05"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), false);
    EXPECT_EQ(json.at("count"), 0);
    EXPECT_EQ(json.at("area"), 0.0);
    EXPECT_TRUE(json.at("box").is_null());
}

}  // namespace
}  // namespace nearfield::test
