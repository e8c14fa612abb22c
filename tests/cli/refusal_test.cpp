#include "cli_test.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>

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

/// One of each format, and what the readers share; all that readers refuse is tested at them.
TEST_F(Refused, WhatIsNoOutlineByItsPlace) {
    expect_bad_outline("broken.geojson",
                       "{\n \"type\": \"Polygon\",\n \"coordinates\": [[[0, 0], [1, 0], [1, 1]]\n}",
                       {"broken.geojson:4:1: "});
    expect_bad_outline("null.geojson",
                       R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1]],
                           [[0, 0], [1, 0], [1, null]]]})",
                       {"coordinates[1][2][1]", "null"});
    expect_bad_outline("letter.wkt", "POLYGON ((0 0, 1 0,\n1 1, 0 x))", {"letter.wkt:2:8: "});
    expect_bad_outline("line.wkt", "LINESTRING (0 0, 1 1)", {"LINESTRING"});
    expect_bad_outline("other.xml", "<polygon/>", {"1:2", "not svg"});
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

TEST_F(Refused, PosesAndRectanglesOutOfRange) {
    expect_refused(ask("penetration", {"-d", "0.1", "--pose-a", "0,1e13,0"}), {"A's pose"});
    expect_refused(ask("penetration", {"-d", "0.1", "--pose-a", "0,0,1e10"}),
                   {"--pose-a", "1e+10 degrees", "too large"});
    for (const auto& rectangle : {"0,0,1", "0,0,1,1,1", "0,0,0,1", "0,1,1,0"}) {
        expect_refused(ask("distance-field", {"-d", "0.1", "--rect", rectangle}),
                       {"--rect", rectangle});
    }
}

TEST_F(Refused, NamesThatAreNotKnown) {
    expect_refused(ask("frobnication", {"-d", "1"}), {"frobnication", "penetration"});
    expect_refused(ask("Penetration", {"-d", "1"}), {"Penetration"});
    expect_refused(ask("penetration", {"-d", "1", "--points", "some"}), {"--points", "vertices"});
    expect_refused(ask("intersection", {"-d", "1", "--kind", "volume"}), {"--kind", "volume"});
    expect_refused(squares("penetration", "magic") + Arguments{"-d", "1"},
                   {"--technique", "magic", "raster", "cpu", "automatic"});
    expect_refused(ask("contacts", {"-d", "1", "--normals", "wrong"}),
                   {"--normals", "wrong", "analytic"});
    expect_refused(ask("intersection", {"-d", "1", "--strategy", "magic"}),
                   {"--strategy", "magic", "stencil", "blend", "logic-op", "depth"});
    expect_refused(squares("penetration") + Arguments{a_, "-d", "1"}, {a_});
    expect_refused({"frobnicate"}, {"frobnicate", "query", "bench", "info"});
    expect_refused({}, {"subcommand"});
}

TEST_F(Refused, WhatATechniqueDoesNotAnswer) {
    for (const auto& [kind, technique, words] :
         {std::array{"containment", "compute", "containment"},
          std::array{"intersection-test", "raster", "intersection tests"},
          std::array{"time-of-impact", "raster", "times of impact"},
          std::array{"separation-vector", "compute", "separation vectors"}}) {
        expect_refused(squares(kind, technique) + Arguments{"-d", "0.1"},
                       {technique, words, "automatic"});
    }
    const Arguments blended{"-d", "0.1", "--gradient", "blended", "--at", "0.5,0.5"};
    for (const char* technique : {"cpu", "compute"}) {
        expect_refused(squares("distance-field", technique) + blended,
                       {std::string("technique ") + technique, "blended"});
    }
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
