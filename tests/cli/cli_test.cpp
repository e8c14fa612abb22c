#include "cli_test.hpp"

namespace nearfield::test {

Arguments operator+(Arguments first, const Arguments& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

CliTest::CliTest()
    : a_(folder_.write(
          "a square.geojson",
          R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]})")),
      b_(folder_.write("b square.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\n")) {}

Arguments CliTest::squares(const std::string& type, const std::string& technique) const {
    return {"query", type, a_, b_, "--technique", technique};
}

Json CliTest::answer(const Arguments& query) {
    const Arguments arguments = query + Arguments{"--json", "-"};
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.status, 0) << command_line(arguments) << '\n' << outcome.err;
    Json json = Json::parse(outcome.out, nullptr, false);
    if (outcome.status != 0 || json.is_discarded()) {
        ADD_FAILURE() << command_line(arguments) << "\nprints no JSON: " << outcome.out;
        return nullptr;
    }
    return json;
}

double CliTest::distance_at(const std::string& file, const std::string& point,
                            const Arguments& options) const {
    const Json json = answer(Arguments{"query", "distance-field", a_, file, "-d", "0.02", "--rect",
                                       "-3,-3,8,8", "--at", point, "--technique", "cpu"} +
                             options);
    return json.is_object() ? json.at("points").at(0).at("distance").get<double>() : 1e9;
}

void CliTest::expect_refused(const Arguments& arguments,
                             const std::vector<std::string>& parts) const {
    const auto before = folder_.contents();
    const Outcome outcome = run_program(arguments);
    const std::string context = command_line(arguments) + "\n" + outcome.err;
    EXPECT_EQ(outcome.status, 2) << context;
    EXPECT_EQ(outcome.out, "") << context;
    EXPECT_TRUE(outcome.err.find("nearfield: ") != std::string::npos) << context;
    for (const std::string& part : parts) {
        EXPECT_TRUE(outcome.err.find(part) != std::string::npos) << context << "lacks: " << part;
    }
    EXPECT_TRUE(folder_.contents() == before) << context << "and leaves other files than before";
}

}  // namespace nearfield::test
