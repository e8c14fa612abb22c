#include "cli_test.hpp"

#include <cstddef>
#include <cstdlib>
#include <utility>

namespace nearfield::test {
namespace {

class Refused : public CliTest {
protected:
    /// A valid query with outputs that must not appear when it is rejected.
    Arguments ask(const std::string& type, const Arguments& options) const {
        return squares(type) + options +
               Arguments{"--json", folder_.path("answer.json"), "--image", folder_.path("i.png")};
    }

    /// Expects that an invalid outline is rejected, as A and as B.
    void expect_bad_outline(const std::string& name, const std::string& text,
                            const std::vector<std::string>& parts,
                            const Arguments& options = {}) const {
        const std::string file = folder_.write(name, text);
        std::vector<std::string> all = parts;
        all.push_back(file);
        for (const Arguments& pair : {Arguments{file, b_}, Arguments{a_, file}}) {
            expect_refused(Arguments{"query", "penetration"} + pair +
                               Arguments{"-d", "0.1", "--json", folder_.path("answer.json")} +
                               options,
                           all);
        }
    }
};

TEST_F(Refused, FilesThatCannotBeRead) {
    const std::string missing = folder_.path("missing.wkt");
    expect_refused({"query", "penetration", missing, b_, "-d", "1"}, {missing, "cannot be opened"});
    expect_refused({"query", "penetration", a_, missing, "-d", "1"}, {missing, "cannot be opened"});
    expect_refused({"query", "penetration", a_, folder_.path(""), "-d", "1"}, {"is a folder"});
    expect_bad_outline("empty.wkt", "", {"is empty"});
}

TEST_F(Refused, PicturesOfOtherFormats) {
    const Arguments query = squares("penetration") + Arguments{"-d", "0.1"};
    expect_refused(query + Arguments{"--image", folder_.path("out.jpg")}, {"out.jpg", "PNG"});
    expect_refused({"simulate", "wavy", "--frames", "2", "--image", folder_.path("%d.svg")},
                   {"%d.svg", "PNG"});
    expect_refused({"bench", "--paper", "--curves", folder_.path("c.pdf")}, {"c.pdf", "PNG"});
}

TEST_F(Refused, BrokenJsonByLineAndColumn) {
    expect_bad_outline("broken.geojson",
                       "{\n \"type\": \"Polygon\",\n \"coordinates\": [[[0, 0], [1, 0], [1, 1]]\n}",
                       {"broken.geojson:4:1: "});
    expect_bad_outline("nan.geojson",
                       R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, NaN]]]})",
                       {"nan.geojson:1:"});
    expect_bad_outline("large.geojson",
                       "{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 0], [1, 0], [1, 1e999]]]}",
                       {"large.geojson:2:"});
}

TEST_F(Refused, BrokenWellKnownTextByLineAndColumn) {
    expect_bad_outline("letter.wkt", "POLYGON ((0 0, 1 0,\n1 1, 0 x))", {"letter.wkt:2:8: "});
    expect_bad_outline("open.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0)", {"open.wkt:1:35: "});
    expect_bad_outline("nan.wkt", "POLYGON ((0 0, 1 0, 1 nan))", {"nan.wkt:1:23: "});
    expect_bad_outline("infinite.wkt", "POLYGON ((0 0, 1 0, 1 -inf))", {"infinite.wkt:1:23: "});
    expect_bad_outline("after.wkt", "POLYGON ((0 0, 1 0, 1 1)) 7", {"after.wkt:1:27: "});
}

TEST_F(Refused, WhatIsNoPolygon) {
    expect_bad_outline("line.wkt", "LINESTRING (0 0, 1 1)", {"LINESTRING"});
    expect_bad_outline("line.geojson", R"({"type": "LineString", "coordinates": [[0, 0], [1, 1]]})",
                       {"no polygon", "LineString"});
    expect_bad_outline("list.geojson", "[]", {"object"});
    expect_bad_outline("other.xml", "<polygon/>", {"1:2", "not svg"});
    expect_bad_outline("none.wkt", "POLYGON EMPTY", {"empty"});
    expect_bad_outline("none.geojson", R"({"type": "Polygon", "coordinates": []})", {"empty"});
}

TEST_F(Refused, RingsThatEncloseNothingByTheirNumber) {
    const std::string outer = "(0 0, 4 0, 4 4, 0 4, 0 0)";
    expect_bad_outline("two.wkt", "POLYGON ((0 0, 1 1, 0 0))", {"ring 0", "three"});
    expect_bad_outline("repeated.wkt", "POLYGON (" + outer + ", (1 1, 2 2, 1 1, 2 2))",
                       {"ring 1", "three"}, {"--strict"});
    expect_bad_outline("flat.wkt", "POLYGON (" + outer + ", (1 1, 2 2, 3 3, 1 1))",
                       {"ring 1", "line"}, {"--strict"});
    expect_bad_outline("two.geojson",
                       R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]})",
                       {"ring 0", "three"});
}

TEST_F(Refused, AllBadRingsByTheirNumbersAndPlaces) {
    expect_bad_outline(
        "many.wkt",
        "MULTIPOLYGON (((0 0, 4 0, 4 4)), ((1 1, 2 2, 3 3)), ((9 8, 7 6, 9 8)), "
        "((0 5, 1 5, 1 1e13)))",
        {"3 of 4 rings are bad", "ring 1 from (1, 1) lies on one line",
         "ring 2 from (9, 8) has fewer than three", "ring 3 from (0, 5), vertex 2: y is 1e+13"});
    std::string flat = "MULTIPOLYGON (((0 0, 4 0, 4 4))";
    for (int i = 0; i < 50; ++i) {
        flat += ", ((1 1, 2 2, 3 3))";
    }
    expect_bad_outline("flat.wkt", flat + ")", {"50 of 51 rings", "ring 20 from", "and 30 more"},
                       {"--strict"});
    EXPECT_EQ(
        run_program({"query", "penetration", folder_.path("flat.wkt"), b_, "-d", "1", "--strict"})
            .err.find("ring 21 "),
        std::string::npos);
}

TEST_F(Refused, CoordinatesByRingAndVertex) {
    expect_bad_outline("far.wkt", "POLYGON ((0 0, 1 0, 1 1e13))", {"ring 0", "vertex 2", "y"});
    expect_bad_outline("null.geojson",
                       R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1]],
                           [[0, 0], [1, 0], [1, null]]]})",
                       {"coordinates[1][2][1]", "null"});
    expect_bad_outline("short.geojson",
                       R"({"type": "Polygon", "coordinates": [[[0, 0], [1], [1, 1]]]})",
                       {"coordinates[0][1]", "two numbers"});
}

TEST_F(Refused, TolerancesThatAreNone) {
    for (const auto& tolerance : {"0", "-1", "nan", "inf", "1e999", "0.1x", "x", "", " 1"}) {
        expect_refused(ask("penetration", {"-d", tolerance}),
                       {"-d", '"' + std::string(tolerance) + '"'});
    }
    expect_refused(ask("penetration", {}), {"-d", "required"});
    expect_refused(squares("penetration") + Arguments{"-d"}, {"-d"});
    expect_refused(ask("penetration", {"-d", "1", "-d", "2"}), {"-d"});
}

TEST_F(Refused, PosesAndRectanglesThatAreNone) {
    for (const auto& option : {"--pose-a", "--pose-b"}) {
        for (const auto& pose : {"", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "0,0,inf", "1 2 3"}) {
            expect_refused(ask("penetration", {"-d", "0.1", option, pose}), {option, pose});
        }
    }
    expect_refused(ask("penetration", {"-d", "0.1", "--pose-a", "0,1e13,0"}), {"A's pose"});
    expect_refused(ask("penetration", {"-d", "0.1", "--pose-a", "0,0,1e10"}),
                   {"--pose-a", "1e+10 degrees", "too large"});
    for (const auto& rectangle : {"", "0,0,1", "0,0,1,1,1", "0,0,0,1", "0,1,1,0", "0,0,1,nan"}) {
        expect_refused(ask("distance-field", {"-d", "0.1", "--rect", rectangle}),
                       {"--rect", rectangle});
    }
}

TEST_F(Refused, NamesThatAreNotKnown) {
    expect_refused(ask("frobnication", {"-d", "1"}), {"frobnication", "penetration"});
    expect_refused(ask("Penetration", {"-d", "1"}), {"Penetration"});
    expect_refused(ask("penetration", {"-d", "1", "--points", "some"}), {"--points", "vertices"});
    expect_refused(ask("intersection", {"-d", "1", "--kind", "volume"}), {"--kind", "volume"});
    expect_refused(ask("penetration", {"-d", "1", "--technique", "magic"}), {"--technique"});
    expect_refused(ask("intersection", {"-d", "1", "--strategy", "magic"}),
                   {"--strategy", "magic", "stencil", "blend", "logic-op", "depth"});
    expect_refused(ask("penetration", {"-d", "1", "--frobnicate"}), {"--frobnicate"});
    expect_refused({"query", "penetration", a_, "-d", "1"}, {"B"});
    expect_refused(squares("penetration") + Arguments{a_, "-d", "1"}, {a_});
    expect_refused({"frobnicate"}, {"frobnicate", "query", "bench", "info"});
    expect_refused({}, {"subcommand"});
}

TEST_F(Refused, GradientsByBlendingOfTheComputeTechnique) {
    const Arguments asked{"query", "distance-field", a_, b_, "-d", "1", "--technique", "compute"};
    const Arguments blended{"--at", "0.5,0.5", "--gradient", "blended"};
    expect_refused(asked + blended, {"compute", "blended"});
}

TEST_F(Refused, AFieldOfNothingInCommon) {
    expect_refused(ask("distance-field", {"-d", "0.1", "--pose-b", "3,0,0"}),
                   {"nothing in common", "rectangle"});
}

/// The smallest tolerance that a message names; 0 if it names none.
double smallest_named(const std::string& message) {
    const std::string lead = "the smallest tolerance that fits is about ";
    const std::size_t place = message.find(lead);
    return place == std::string::npos ? 0.0
                                      : std::strtod(message.c_str() + place + lead.size(), nullptr);
}

TEST_F(Refused, TolerancesThatNeedTooMuchMemoryWithTheSmallestPossible) {
    for (const auto& query : {"penetration", "intersection", "distance-field"}) {
        const Arguments far_too_fine{"-d", "1e-10"};
        const double named = smallest_named(run_program(ask(query, far_too_fine)).err);
        EXPECT_GT(named, 1e-10) << query;
        EXPECT_LT(named, 1e-3) << query;
        expect_refused(ask(query, far_too_fine), {"1e-10"});
        // A slightly finer tolerance than the named one is still rejected, so the named one is
        // tight.
        const std::string finer = std::to_string(named * 1e9 / 1.5) + "e-9";
        const double again = smallest_named(run_program(ask(query, {"-d", finer})).err);
        EXPECT_NEAR(again, named, 0.1 * named) << query << ", tolerance " << finer;
    }
    expect_refused(ask("penetration", {"-d", "1e-300"}), {"1e-300", "smallest"});
    // The option that sets the limit is named, and sets it.
    const Arguments fine{"query", "penetration", a_, b_, "-d", "1e-4", "--technique", "cpu"};
    EXPECT_EQ(run_program(fine).status, 0);
    expect_refused(fine + Arguments{"--memory-limit", "1"}, {"too_large", "--memory-limit"});
    EXPECT_EQ(run_program(fine + Arguments{"--memory-limit", "2000"}).status, 0);
    for (const auto& limit : {"0", "1.5", "x", "1048577"}) {
        expect_refused(fine + Arguments{"--memory-limit", limit}, {"--memory-limit", limit});
    }
}

}  // namespace
}  // namespace nearfield::test
