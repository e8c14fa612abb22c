#include "support.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tests/support/folder.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/output_file.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

using nlohmann::json;

json written(const QueryRequest& request, const AnyResult& result) {
    Timings timings;
    timings.plan = 0.1;
    timings.passes = {{"fill", 0.25}, {"resolve", 1e-9}};
    const std::string device = "a \"device\"\n\xFF";
    std::ostringstream stream;
    write_query_json(stream, {request, result, timings, device});
    return json::parse(stream.str());
}

void fill_summary(ResultSummary& summary) {
    summary.tolerance = 0.1;
    summary.error_bound = 1.0 / 3.0;
    summary.intersects = true;
    summary.cell = 0.1 * std::sqrt(2.0);
    summary.regions = {{{-1, 2}, {3, 4.5}, 40, 25}};
    summary.localization = {7, 5, 3};
}

TEST(ToolsJson, PenetrationHasTheKeysOfTheContract) {
    PenetrationResult result;
    fill_summary(result);
    result.count = 1;
    result.deepest = {{0.1, 0.2}, 0.3, {0.6, 0.8}, {0.28, 0.44}, {Feature::Kind::vertex, 7}, false};
    result.points = {result.deepest};
    const json answer = written({}, result);
    EXPECT_EQ(answer["query"], "penetration");
    EXPECT_EQ(answer["tolerance"], 0.1);
    EXPECT_EQ(answer["error_bound"], 1.0 / 3.0);  // every bit survives
    EXPECT_EQ(answer["intersects"], true);
    EXPECT_EQ(answer["device"], "a \"device\"\n\xEF\xBF\xBD");
    EXPECT_EQ(answer["technique"], "raster");
    EXPECT_EQ(answer["regions"],
              json::parse(R"([{"min": [-1, 2], "max": [3, 4.5], "width": 40, "height": 25}])"));
    EXPECT_EQ(
        answer["timings_ms"],
        json::parse(R"({"plan": 0.1, "total": 0, "passes": {"fill": 0.25, "resolve": 1e-9}})"))
        << "and no stage that did not take place";
    EXPECT_EQ(answer["count"], 1);
    EXPECT_EQ(answer["deepest"],
              json::parse(R"({"point": [0.1, 0.2], "depth": 0.3, "direction": [0.6, 0.8]})"));
    EXPECT_EQ(answer["records"],
              json::parse(R"([{"point": [0.1, 0.2], "depth": 0.3, "direction": [0.6, 0.8],
                     "nearest": [0.28, 0.44], "feature": {"vertex": 7}, "unique": false}])"));
    EXPECT_EQ(answer["cell"], 0.1 * std::sqrt(2.0));
    EXPECT_EQ(answer["localization"],
              json({{"nodes_evaluated", 7}, {"pairs_rejected", 5}, {"edges_kept", 3}}));
    EXPECT_EQ(answer.size(), 13U);
}

TEST(ToolsJson, NothingFoundIsNullAndEmpty) {
    const json answer = written({}, PenetrationResult{});
    EXPECT_TRUE(answer["deepest"].is_null());
    EXPECT_EQ(answer["records"], json::array());
    EXPECT_EQ(answer["regions"], json::array());
}

TEST(ToolsJson, IntersectionNamesEdgesOnlyWhereABoundaryTakesPart) {
    QueryRequest request;
    request.type = QueryType::intersection;
    IntersectionResult result;
    fill_summary(result);
    result.count = 2;
    result.area = 0.04;
    result.strategy = IntersectionStrategy::logic_op;
    result.box = {{0.5, 1}, {0.75, 1}};
    result.samples = {{{0.5, 1}, 3}, {{0.75, 1}, IntersectionSample::no_edge}};
    json answer = written(request, result);
    EXPECT_EQ(answer["query"], "intersection");
    EXPECT_EQ(answer["kind"], "volume-volume");
    EXPECT_EQ(answer["count"], 2);
    EXPECT_EQ(answer["area"], 0.04);
    EXPECT_EQ(answer["strategy"], "logic-op");
    EXPECT_EQ(answer["box"], json::parse(R"({"min": [0.5, 1], "max": [0.75, 1]})"));
    EXPECT_EQ(answer["samples"], json::parse("[[0.5, 1], [0.75, 1]]"));
    EXPECT_FALSE(answer.contains("edges"));
    result.kind = IntersectionKind::boundary_volume;
    answer = written(request, result);
    EXPECT_EQ(answer["kind"], "boundary-volume");
    EXPECT_EQ(answer["edges"], json::parse("[3, null]"));
    result.count = 0;
    EXPECT_TRUE(written(request, result)["box"].is_null());
}

TEST(ToolsJson, DistanceFieldSaysWhereItsGridLies) {
    QueryRequest request;
    request.type = QueryType::distance_field;
    DistanceFieldResult result;
    fill_summary(result);
    result.origin = {1e6, -2};
    result.width = 40;
    result.height = 25;
    const json answer = written(request, result);
    EXPECT_EQ(answer["origin"], json::parse("[1e6, -2]"));
    EXPECT_EQ(answer["cell"], 0.1 * std::sqrt(2.0));
    EXPECT_EQ(answer["width"], 40);
    EXPECT_EQ(answer["height"], 25);
}

TEST(ToolsJson, NumbersThatJsonCannotHoldAreNull) {
    std::ostringstream stream;
    JsonWriter writer(stream);
    writer.begin_array().value(std::numeric_limits<double>::infinity()).value(-0.5).end_array();
    EXPECT_EQ(stream.str(), "[null, -0.5]");
}

TEST(ToolsNpy, WordsAndPairsSaySoInTheirHeaders) {
    std::ostringstream words;
    const std::vector<std::uint32_t> ids{1, 2, 0x80000003U, 4, 5, 6};
    write_npy(words, ids, 3, 2);
    EXPECT_NE(words.str().find("{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }"),
              std::string::npos);
    EXPECT_EQ(words.str().substr(words.str().size() - 16, 4), std::string("\x03\x00\x00\x80", 4));
    std::ostringstream pairs;
    const std::vector<float> numbers(12, 1.0F);
    write_npy_pairs(pairs, numbers, 3, 2);
    EXPECT_NE(pairs.str().find("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 2), }"),
              std::string::npos);
    EXPECT_EQ(pairs.str().size() % 64, 48U);
}

TEST(ToolsNpy, ReadsBackAsWritten) {
    for (const std::uint32_t width : {1U, 3U, 100'000U}) {
        const std::uint32_t height = 2;
        std::vector<float> values;
        for (std::uint32_t index = 0; index < width * height; ++index) {
            values.push_back(static_cast<float>(index) - 1.5F);
        }
        std::ostringstream stream;
        write_npy(stream, values, width, height);
        const std::string bytes = stream.str();
        ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
        const std::size_t length =
            static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
        const std::size_t data = 10 + length;
        EXPECT_EQ(data % 64, 0U);
        const std::string header = bytes.substr(10, length);
        EXPECT_EQ(header.back(), '\n');
        EXPECT_EQ(header.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2, " +
                              std::to_string(width) + "), }"),
                  0U);
        ASSERT_EQ(bytes.size(), data + values.size() * sizeof(float));
        EXPECT_EQ(std::memcmp(bytes.data() + data, values.data(), values.size() * sizeof(float)),
                  0);
    }
}

TEST(ToolsOutputFile, AppearsWholeOrNotAtAll) {
    const test_support::Folder folder;
    folder.write("out", "former");
    {
        OutputFile file(folder.path("out"));
        file.stream() << "half";
    }
    EXPECT_EQ(folder.read("out"), "former");
    EXPECT_EQ(folder.contents().size(), 1U);
    {
        OutputFile file(folder.path("out"));
        file.stream() << "whole";
        EXPECT_EQ(folder.read("out"), "former");
        file.commit();
    }
    EXPECT_EQ(folder.read("out"), "whole");
    EXPECT_EQ(folder.contents().size(), 1U);
}

TEST(ToolsOutputFile, TargetsThatCannotBeWrittenAreRefusedAtOnce) {
    const test_support::Folder folder;
    const std::string inside = folder.path("none/out");
    EXPECT_EQ(input_error([&] { return OutputFile(inside), 0; }),
              inside + ": cannot be written: No such file or directory");
    EXPECT_EQ(input_error([&] { return OutputFile(folder.path("")), 0; }),
              folder.path("") + ": cannot be written: is a folder");
}

TEST(ToolsOutputFile, DevicesStayDevices) {
    OutputFile file("/dev/null");
    file.stream() << "gone";
    file.commit();
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace nearfield::tools
