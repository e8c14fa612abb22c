#include "cli_test.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>

namespace nearfield::test {
namespace {

/// The record of a nesting tool (tests/data/layouts/sheet.svg): 15 parts of five kinds on a sheet,
/// turned, mirrored, one within the hole of another one. Gusset 3 reaches 4 mm over the edge, and
/// plate 2 reaches 2 mm into bracket 4.
class NestingRecord : public CliTest {
protected:
    const std::string record_ = NEARFIELD_TEST_DATA "/layouts/sheet.svg";
    const std::set<std::string> parts_{"bracket-1", "bracket-2", "bracket-3", "bracket-4",
                                       "plate-1",   "plate-2",   "plate-3",   "gasket-1",
                                       "gasket-2",  "washer-1",  "washer-2",  "washer-3",
                                       "gusset-1",  "gusset-2",  "gusset-3"};

    using Pair = std::pair<std::string, std::string>;
};

TEST_F(NestingRecord, OneCommandAnswersContainmentAndOverlapOfAllItems) {
    const Outcome outcome = run_program({"scene", record_, "--units", "mm", "--json", "-"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("sheet.svg: skipped what has no outline: text (1)"),
              std::string::npos)
        << outcome.err;
    const Json json = Json::parse(outcome.out);
    std::map<std::string, double> clearances;
    std::set<std::string> tested;
    std::set<Pair> overlaps;
    for (const Json& result : json.at("results")) {
        ASSERT_EQ(result.at("status"), "ok");
        const Pair pair{result.at("a"), result.at("b")};
        if (result.at("query") == "containment" && pair.second == "bin") {
            tested.insert(pair.first);
            if (result.at("inside") == true) {
                clearances[pair.first] = result.at("clearance");
            }
        } else if (result.at("query") == "containment") {
            // No part lies within another one: holes are no part of it.
            EXPECT_EQ(result.at("inside"), false) << pair.first << " in " << pair.second;
        } else if (result.at("intersects") == true && pair.first != "bin" && pair.second != "bin") {
            overlaps.insert(pair);
        }
    }
    EXPECT_EQ(tested, parts_);
    EXPECT_EQ(overlaps, (std::set<Pair>{{"bracket-4", "plate-2"}}));
    EXPECT_EQ(clearances.size(), 14U);
    EXPECT_EQ(clearances.count("gusset-3"), 0U);
    EXPECT_NEAR(clearances.at("bracket-1"), 5.0, 1e-9);
    EXPECT_NEAR(clearances.at("gasket-1"), 10.0, 0.002);
    EXPECT_NEAR(clearances.at("washer-3"), 10.0, 0.002);
    EXPECT_NEAR(clearances.at("plate-3"), 100.0, 0.002);
    EXPECT_NEAR(clearances.at("gusset-2"), 160.0, 1e-9);
}

}  // namespace
}  // namespace nearfield::test
