#include "cli_test.hpp"

#include <cstddef>

namespace nearfield::test {
namespace {

/// An integer option: the command line before it, and its range.
struct CountOption {
    Arguments line;
    std::string option;
    std::string min;
    std::string max;
    std::string too_many;  ///< one more than the maximum
};

class Numbers : public CliTest {
protected:
    /// Every count option of every command.
    [[nodiscard]] std::vector<CountOption> count_options() const {
        const std::string scene = folder_.write("scene.json", R"({
            "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1]]]}},
            "instances": {"A": {"shape": "square"}},
            "queries": [{"query": "penetration", "a": "A", "b": "A", "tolerance": 0.1}]})");
        const Arguments bench{"bench", "--scene", scene};
        const Arguments impact = squares("time-of-impact", "cpu") + Arguments{"-d", "1"};
        const Arguments vector = squares("separation-vector", "cpu") + Arguments{"-d", "1"};
        std::vector<CountOption> options{
            {impact, "--most-steps", "1", "1000000000", "1000000001"},
            {vector, "--most-work", "1", "1000000000", "1000000001"},
            {bench, "--frames", "1", "1000000", "1000001"},
            {bench, "--warmup", "0", "1000000", "1000001"},
            {{"simulate", "map"}, "--frames", "1", "10000000", "10000001"},
            {{"simulate", "pour"}, "--bodies", "1", "1000", "1001"},
            {{"simulate", "map", "--image", folder_.path("%d.png")},
             "--every",
             "1",
             "10000000",
             "10000001"}};
        for (const Arguments& line : {squares("penetration") + Arguments{"-d", "1"}, impact, bench,
                                      Arguments{"scene", scene}, Arguments{"simulate", "map"}}) {
            options.push_back({line, "--threads", "1", "256", "257"});
            options.push_back({line, "--height", "0", "32", "33"});
        }
        return options;
    }
};

TEST_F(Numbers, CountsThatAreNoDecimalWholeNumbersAreRefused) {
    const auto refuse = [this](const CountOption& option, const std::string& text) {
        expect_refused(option.line + Arguments{option.option, text},
                       {option.option + ": \"" + text + "\" is not a whole number"});
    };
    for (const CountOption& option : count_options()) {
        refuse(option, "1.5");
    }
}

TEST_F(Numbers, CountsOutOfRangeAreRefusedWithTheRange) {
    for (const CountOption& option : count_options()) {
        const std::string range = "is out of range " + option.min + " to " + option.max;
        expect_refused(option.line + Arguments{option.option, option.too_many},
                       {option.option + ": \"" + option.too_many + "\" " + range});
        if (option.min != "0") {
            expect_refused(option.line + Arguments{option.option, "0"}, {range});
        }
    }
}

TEST_F(Numbers, CountsAreDecimal) {
    const Arguments query = squares("separation-vector", "cpu") +
                            Arguments{"-d", "0.01", "--pose-b", "0.75,0.1,0", "--most-work"};
    // The work that was done shows which number was parsed.
    const Json hundred = answer(query + Arguments{"100"});
    ASSERT_TRUE(hundred.is_object());
    for (const char* text : {"0100", "1e2", "100.0"}) {
        EXPECT_EQ(answer(query + Arguments{text}).at("work"), hundred.at("work")) << text;
    }
    EXPECT_NE(answer(query + Arguments{"1000000"}).at("work"), hundred.at("work"));
    EXPECT_EQ(
        answer(query + Arguments{"1000000000", "--threads", "256", "--height", "32"}).at("work"),
        answer(query + Arguments{"1e9", "--threads", "1", "--height", "0"}).at("work"));
}

TEST_F(Numbers, RealsThatAreNoPositiveNumbersAreRefused) {
    const Arguments query = squares("time-of-impact", "cpu");
    const auto refuse = [this](const Arguments& line, const char* option, const std::string& text) {
        expect_refused(line + Arguments{option, text},
                       {"\"" + text + "\"", "finite number greater than 0"});
    };
    refuse(query, "-d", "0");
    for (const char* const option : {"--deviation", "--time-bound", "--contact-distance"}) {
        refuse(query + Arguments{"-d", "1"}, option, "0");
    }
    for (const char* const option : {"-d", "--tolerance"}) {
        refuse({"simulate", "map"}, option, "0");
    }
}

TEST_F(Numbers, PosesPointsAndRectanglesAreFiniteNumbers) {
    const Arguments impact = squares("time-of-impact", "cpu") + Arguments{"-d", "1"};
    const Arguments field = squares("distance-field", "cpu") + Arguments{"-d", "1"};
    for (const char* option : {"--pose-a", "--pose-b", "--end-pose-a", "--end-pose-b"}) {
        expect_refused(impact + Arguments{option, "0,0,nan"}, {option, "X,Y,DEGREES"});
    }
    expect_refused(field + Arguments{"--at", "0,nan"}, {"--at", "X,Y"});
    expect_refused(field + Arguments{"--rect", "0,0,1,nan"}, {"--rect", "X0,Y0,X1,Y1"});
}

}  // namespace
}  // namespace nearfield::test
