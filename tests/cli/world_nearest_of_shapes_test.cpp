#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using NearestOfShapes = StripScene;

const std::string begin = R"({"query": "nearest", "shape": "square", "against": "items",
                             "poses": [[2.5, 2, 0], [4.25, 1, 0], [7, 1, 0]], )";

TEST_F(NearestOfShapes, AreClearancesInOrder) {
    const Json result = results_of(begin + R"("count": 3, "max_distance": 1.5})").at(0);
    EXPECT_EQ(result.at("query"), "nearest");
    EXPECT_EQ(result.at("shape"), "square");
    EXPECT_EQ(result.at("against"), "items");
    EXPECT_EQ(result.at("count"), 3);
    EXPECT_EQ(result.at("hit_count"), 3);
    EXPECT_EQ(result.at("found"), 5);
    const Json& records = result.at("records");
    ASSERT_EQ(records.size(), 3U);
    // It touches i2, and is as far from i1 as from i3.
    ASSERT_EQ(records.at(0).size(), 3U) << records;
    const std::pair<const char*, double> first[] = {{"i2", 0.0}, {"i1", 0.5}, {"i3", 0.5}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(records.at(0).at(i).at("instance"), first[i].first);
        EXPECT_EQ(records.at(0).at(i).at("distance"), first[i].second);
    }
    EXPECT_TRUE(records.at(0).at(0).at("direction").is_null());
    EXPECT_EQ(records.at(0).at(1).at("direction"), Json({-1.0, 0.0}));
    EXPECT_EQ(records.at(0).at(1).at("point"), Json({2.5, 2.0}));
    EXPECT_EQ(records.at(0).at(1).at("nearest"), Json({2.0, 2.0}));
    // Two corners of i3 are on the boundary of the shape, none inside.
    ASSERT_EQ(records.at(1).size(), 1U) << records;
    EXPECT_EQ(records.at(1).at(0).at("instance"), "i3");
    EXPECT_LE(records.at(1).at(0).at("distance").get<double>(), 0.0);
    ASSERT_EQ(records.at(2).size(), 1U) << records;
    EXPECT_EQ(records.at(2).at(0).at("instance"), "i4");
    EXPECT_EQ(records.at(2).at(0).at("distance"), 1.5);
}

TEST_F(NearestOfShapes, GoIntoTables) {
    folder_.write("poses.csv", "7,1,0\n2.5,2,0\n");
    const Json result = results_of(R"({"query": "nearest", "shape": "square", "against": "items",
        "poses_file": "poses.csv", "count": 2, "max_distance": 5, "values": "near.csv"})")
                            .at(0);
    EXPECT_EQ(result.at("found"), 4);
    const std::string near = folder_.read("near.csv");
    EXPECT_TRUE(
        near.starts_with("pose,distance,error_bound,instance,point_x,point_y,nearest_x,"
                         "nearest_y,direction_x,direction_y\n0,1.5,"))
        << near;
    EXPECT_NE(near.find("\n1,0,"), std::string::npos) << near;
}

TEST_F(NearestOfShapes, EdgesAreInOrder) {
    const Json result =
        results_of(begin + R"("kind": "edges", "count": 20, "max_distance": 0.75})").at(0);
    EXPECT_EQ(result.at("query"), "nearest");
    EXPECT_EQ(result.at("count"), 3);
    const Json& records = result.at("records");
    ASSERT_EQ(records.size(), 3U);
    double before = 0.0;
    std::size_t touching = 0;
    for (const Json& record : records.at(0)) {
        const double distance = record.at("distance");
        EXPECT_GE(distance, before);
        EXPECT_LE(distance, 0.75);
        EXPECT_EQ(record.at("direction").is_null(), distance == 0.0);
        EXPECT_LT(record.at("edge"), 4);
        EXPECT_EQ(record.at("point").size(), 2U);
        EXPECT_EQ(record.at("nearest").size(), 2U);
        touching += distance == 0.0 ? 1 : 0;
        before = distance;
    }
    // It touches an edge of i2, or two at their common corner.
    EXPECT_GE(touching, 1U);
    EXPECT_EQ(records.at(0).at(0).at("instance"), "i2");
    EXPECT_TRUE(records.at(2).empty());
}

TEST_F(NearestOfShapes, NeedPoses) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"query": "nearest"})", ": needs either \"points\", or \"shape\" and \"poses\""},
        {R"({"query": "nearest", "points": [], "shape": "square"})",
         ".shape: belongs to \"poses\""},
        {R"({"query": "nearest", "points": [], "shape": "square", "poses": []})",
         ": needs either \"points\""},
        {R"({"query": "nearest", "poses": []})", ": has no \"shape\""},
        {begin + R"("max_distance": -1})", ".max_distance: expected a number of at least 0"}};
    for (const auto& [query, words] : cases) {
        const Outcome outcome = run_program({"scene", scene(query), "--json", "-"});
        EXPECT_EQ(outcome.status, 2) << query;
        EXPECT_NE(outcome.err.find("queries[0]" + words), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace nearfield::test
