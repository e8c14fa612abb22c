#include "cli_test.hpp"

#include <gtest/gtest.h>

namespace nearfield::test {
namespace {

class Calibrate : public CliTest {};

TEST_F(Calibrate, WritesCostsThatOtherCommandsGoBy) {
    const std::string file = folder_.path("costs.json");
    const Outcome outcome = run_program({"calibrate", file});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    Json costs = Json::parse(folder_.read("costs.json"));
    EXPECT_FALSE(costs.at("device").get<std::string>().empty());
    EXPECT_GE(costs.at("overlap").get<double>(), 0.0);
    EXPECT_LE(costs.at("overlap").get<double>(), 1.0);
    const auto expect_times = [](const Json& kinds, const std::string& name) {
        double all = 0.0;
        for (const char* kind : {"points", "closest", "intersection", "field", "features"}) {
            for (const char* part : {"query", "edge", "sample", "search", "shape"}) {
                const double microseconds = kinds.at(kind).at(part);
                EXPECT_GE(microseconds, 0.0) << name << ' ' << kind << ' ' << part;
                all += microseconds;
            }
        }
        EXPECT_GT(all, 0.0) << name;
    };
    for (const std::string stage : {"plan", "answer"}) {
        expect_times(costs.at("microseconds").at("cpu").at(stage), "cpu " + stage);
    }
    for (const std::string technique : {"raster", "compute"}) {
        const Json& cost = costs.at("microseconds").at(technique);
        EXPECT_GE(cost.at("submission").get<double>(), 0.0) << technique;
        EXPECT_GT(cost.at("latency").get<double>(), 0.0) << technique;
        for (const std::string stage : {"plan", "device", "read"}) {
            expect_times(cost.at(stage), technique + ' ' + stage);
        }
    }
    const Arguments query = squares("penetration", "automatic") +
                            Arguments{"-d", "0.1", "--pose-b", "0.6,0,5", "--costs"};
    EXPECT_TRUE(answer(query + Arguments{file}).is_object());
    // Whatever the measurements: a technique that is free while the others are not is selected.
    for (auto& [favourite, cost] : costs.at("microseconds").items()) {
        Json changed = costs;
        for (auto& [technique, other] : changed.at("microseconds").items()) {
            const double microseconds = technique == favourite ? 0.0 : 1.0;
            const Json points = {{"query", microseconds},
                                 {"edge", microseconds},
                                 {"sample", microseconds},
                                 {"search", 0.0},
                                 {"shape", 0.0}};
            for (auto& [name, member] : other.items()) {
                if (member.is_number()) {
                    member = microseconds;
                } else {
                    member.at("points") = points;
                }
            }
        }
        const std::string file_of_favourite = folder_.write("favourite.json", changed.dump());
        EXPECT_EQ(answer(query + Arguments{file_of_favourite}).at("technique"), favourite);
    }
}

TEST_F(Calibrate, RefusesBadFilesBeforeAnyWork) {
    expect_refused({"calibrate"}, {"file"});
    expect_refused({"calibrate", folder_.path("no folder/costs.json")}, {"no folder"});
    expect_refused(squares("penetration", "automatic") +
                       Arguments{"-d", "0.1", "--costs", folder_.path("none.json")},
                   {"none.json"});
}

}  // namespace
}  // namespace nearfield::test
