#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/cost_model.hpp>

#include <sstream>
#include <string>

namespace nearfield::tools {
namespace {

/// A model in which all numbers are different.
CostModel numbered() {
    double next = 0.25;
    const auto number = [&next] { return next += 1.0; };
    const auto set = [&](QueryCosts& costs) {
        for (WorkCost* work :
             {&costs.points, &costs.closest, &costs.intersection, &costs.field, &costs.features}) {
            *work = {number(), number(), number(), number(), number()};
        }
    };
    CostModel costs;
    for (DeviceCosts* technique : {&costs.raster, &costs.compute}) {
        technique->submission = number();
        technique->latency = number();
        for (QueryCosts* stage : {&technique->plan, &technique->device, &technique->read}) {
            set(*stage);
        }
    }
    set(costs.cpu.plan);
    set(costs.cpu.answer);
    costs.overlap = 0.375;
    return costs;
}

std::string text_of(const CostModel& costs) {
    std::ostringstream text;
    write_cost_model(text, costs, "a device");
    return text.str();
}

TEST(ToolsCostModel, IsReadAsItWasWritten) {
    const test_support::Folder folder;
    const CostModel costs = numbered();
    const CostModel read = read_cost_model(folder.write("costs.json", text_of(costs)));
    EXPECT_EQ(text_of(read), text_of(costs));
    EXPECT_EQ(read.cpu.plan.closest.edge, costs.cpu.plan.closest.edge);
    EXPECT_EQ(read.cpu.answer.features.search, costs.cpu.answer.features.search);
    EXPECT_EQ(read.raster.submission, costs.raster.submission);
    EXPECT_EQ(read.compute.latency, costs.compute.latency);
    EXPECT_EQ(read.compute.plan.points.edge, costs.compute.plan.points.edge);
    EXPECT_EQ(read.compute.read.field.sample, costs.compute.read.field.sample);
    EXPECT_EQ(read.cpu.answer.intersection.shape, costs.cpu.answer.intersection.shape);
    EXPECT_EQ(read.overlap, costs.overlap);
}

TEST(ToolsCostModel, BadFilesAreRefusedWithThePlace) {
    const test_support::Folder folder;
    const std::string good = text_of(numbered());
    const auto expect_bad = [&](const std::string& from, const std::string& to,
                                const std::string& reason) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        const std::string file = folder.write("costs.json", text);
        const std::string error = input_error([&] { static_cast<void>(read_cost_model(file)); });
        EXPECT_NE(error.find(file), std::string::npos) << error;
        EXPECT_NE(error.find(reason), std::string::npos) << error;
    };
    expect_bad("{", "[", "not JSON");
    expect_bad("\"microseconds\"", "\"seconds\"", "microseconds");
    expect_bad("\"compute\"", "\"computer\"", "microseconds: has no \"compute\"");
    expect_bad("\"submission\": 1.25", "\"submission\": -1.25", "at least 0");
    expect_bad("\"submission\": 1.25", "\"submission\": \"1\"", "microseconds.raster.submission");
    expect_bad("\"edge\"", "\"edges\"", "microseconds.raster.plan.points");
    expect_bad("\"overlap\": 0.375", "\"overlap\": 1.5", "overlap: expected a number of at");
    expect_bad("\"overlap\": 0.375", "\"overlap\": -0.1", "overlap: expected a number of at");
    expect_bad("\"overlap\"", "\"overlaps\"", "has no \"overlap\"");
}

/// With the kinds of queries where the stages are now.
TEST(ToolsCostModel, FilesOfTheFormerFormAreRefused) {
    const test_support::Folder folder;
    const std::string kinds =
        R"("points": {"query": 1, "edge": 1, "sample": 1}, "field": {"query": 1})";
    const std::string file = folder.write(
        "costs.json", R"({"device": "a device", "microseconds": {"raster": {"submission": 430, )" +
                          kinds + R"(}, "cpu": {"submission": 0.6}}})");
    const std::string error = input_error([&] { static_cast<void>(read_cost_model(file)); });
    EXPECT_NE(error.find("microseconds.raster: has no \"latency\""), std::string::npos) << error;
}

}  // namespace
}  // namespace nearfield::tools
