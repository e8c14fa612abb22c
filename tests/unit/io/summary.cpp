#include <gtest/gtest.h>
#include <tools/io/answer.hpp>

#include <numbers>
#include <sstream>
#include <string>

namespace nearfield::tools {
namespace {

/// The summary's line that begins with an item's name.
std::string line_of(QueryType type, const AnyResult& result, const std::string& item) {
    QueryRequest request;
    request.type = type;
    const Timings timings;
    const std::string device = "a device";
    std::ostringstream stream;
    write_summary(stream, {request, result, timings, device});
    std::istringstream lines(stream.str());
    for (std::string line; std::getline(lines, line);) {
        if (line.find(item) == 0) {
            return line;
        }
    }
    return "no line begins with " + item;
}

bool ends_with(const std::string& line, const std::string& end) {
    return line.size() >= end.size() && line.substr(line.size() - end.size()) == end;
}

template <class Result>
Result one_apart(bool unique) {
    Result result;
    result.distance = 2.0;
    result.feature_b = {Feature::Kind::vertex, 7};
    result.unique = unique;
    return result;
}

TEST(ToolsSummary, OnlyAPairThatIsOneOfSeveralSaysSo) {
    const std::string several = ", one of several pairs";
    EXPECT_TRUE(ends_with(
        line_of(QueryType::separation, one_apart<SeparationResult>(false), "point of B"), several));
    EXPECT_TRUE(
        ends_with(line_of(QueryType::separation, one_apart<SeparationResult>(true), "point of B"),
                  "vertex 7"));
    EXPECT_TRUE(ends_with(
        line_of(QueryType::closest_point, one_apart<ClosestPointResult>(false), "point of B"),
        several));
    EXPECT_TRUE(ends_with(
        line_of(QueryType::closest_point, one_apart<ClosestPointResult>(true), "point of B"),
        "vertex 7"));
}

TEST(ToolsSummary, PosesAreInDegrees) {
    TimeOfImpactResult result;
    result.state = ImpactState::hit;
    result.pose_a = {{1.0, 2.0}, std::numbers::pi / 2.0};
    result.pose_b = {{3.0, 4.0}, -std::numbers::pi};
    EXPECT_TRUE(
        ends_with(line_of(QueryType::time_of_impact, result, "pose of A then"), ", 90 degrees"));
    EXPECT_TRUE(
        ends_with(line_of(QueryType::time_of_impact, result, "pose of B then"), ", -180 degrees"));
}

TEST(ToolsSummary, OnlyADeepestPointWithSeveralWaysOutSaysSo) {
    PenetrationResult result;
    result.count = 1;
    result.deepest.feature = {Feature::Kind::vertex, 7};
    EXPECT_TRUE(ends_with(line_of(QueryType::penetration, result, "nearest"), "vertex 7 of B"));
    result.deepest.unique = false;
    EXPECT_TRUE(ends_with(line_of(QueryType::penetration, result, "nearest"),
                          "vertex 7 of B, one of several"));
}

TEST(ToolsSummary, OnlyAFieldPointWithSeveralNearestPointsSaysSo) {
    DistanceFieldResult result;
    result.points.resize(1);
    result.points[0].feature = {Feature::Kind::vertex, 7};
    EXPECT_TRUE(ends_with(line_of(QueryType::distance_field, result, "at "), "vertex 7"));
    result.points[0].unique = false;
    EXPECT_TRUE(
        ends_with(line_of(QueryType::distance_field, result, "at "), "vertex 7, one of several"));
}

TEST(ToolsSummary, ContactsInsideHaveADepthAndOthersADistance) {
    ContactResult result;
    result.manifold.resize(1);
    result.manifold[0].extreme.distance = 0.25;
    const auto text = [&] {
        QueryRequest request;
        request.type = QueryType::contacts;
        const Timings timings;
        const std::string device;
        std::ostringstream stream;
        const AnyResult any = result;
        write_summary(stream, {request, any, timings, device});
        return stream.str();
    };
    EXPECT_NE(text().find(", distance 0.25"), std::string::npos) << text();
    result.manifold[0].extreme.inside = true;
    EXPECT_NE(text().find(", depth 0.25"), std::string::npos) << text();
}

}  // namespace
}  // namespace nearfield::tools
