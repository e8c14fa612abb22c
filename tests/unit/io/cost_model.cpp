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
    CostModel costs;
    for (TechniqueCost* technique : {&costs.raster, &costs.compute, &costs.cpu}) {
        technique->submission = number();
        for (WorkCost* work : {&technique->points, &technique->closest, &technique->intersection,
                               &technique->field, &technique->features}) {
            *work = {number(), number(), number()};
        }
    }
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
    EXPECT_EQ(read.cpu.features.sample, costs.cpu.features.sample);
    EXPECT_EQ(read.raster.submission, costs.raster.submission);
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
    expect_bad("\"edge\"", "\"edges\"", "microseconds.raster.points");
}

}  // namespace
}  // namespace nearfield::tools
