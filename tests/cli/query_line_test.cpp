#include "cli_test.hpp"

#include <utility>

namespace nearfield::test {
namespace {

/// Accepted forms of a `query` command line, and the messages for wrong ones.
class QueryLine : public CliTest {
protected:
    /// The answer to words after "query --json -", without the members that differ between runs.
    static Json lasting(const Arguments& after) {
        const Arguments words = Arguments{"query", "--json", "-"} + after;
        const Outcome outcome = run_program(words);
        EXPECT_EQ(outcome.status, 0) << command_line(words) << '\n' << outcome.err;
        Json json = Json::parse(outcome.out, nullptr, false);
        if (!json.is_object()) {
            ADD_FAILURE() << command_line(words) << "\nprints no JSON: " << outcome.out;
            return nullptr;
        }
        json.erase("timings_ms");
        return json;
    }

    const std::string pose_ = "0.6,0.3,5";
};

TEST_F(QueryLine, OptionsStandBeforeTheKindAfterItAndBetweenTheFiles) {
    const std::string& a = a_;
    const std::string& b = b_;
    const std::string& p = pose_;
    const Json expected = lasting({"penetration", a, b, "-d", "0.1", "--pose-b", p});
    ASSERT_TRUE(expected.is_object());
    EXPECT_GT(expected.at("count"), 0);
    for (const Arguments& words :
         {Arguments{"-d", "0.1", "--pose-b", p, "penetration", a, b},
          Arguments{"-d0.1", "--pose-b=" + p, "penetration", a, b},
          Arguments{"-d", "0.1", "penetration", a, "--pose-b", p, b},
          Arguments{"penetration", "-d", "0.1", a, b, "--pose-b=" + p},
          Arguments{"--pose-b=", p, "penetration", a, b, "-d", "0.1"},
          Arguments{"--points", "boundary", "-d", "0.1", "penetration", a, b, "--pose-b", p},
          Arguments{"--tiles=false", "penetration", a, b, "-d", "0.1", "--pose-b", p},
          Arguments{"-d", "0.1", "--pose-b", p, "--", "penetration", a, b},
          Arguments{"penetration", "-d", "0.1", "--pose-b", p, "--", a, b}}) {
        EXPECT_EQ(lasting(words), expected) << command_line(words);
    }
}

TEST_F(QueryLine, ValuesAreNoKinds) {
    const Arguments rest{"-d", "0.1", "--pose-b", pose_};
    // The values of --points and --kind do not count as kinds, nor does a file named like a kind.
    EXPECT_EQ(lasting(Arguments{"--points", "vertices", "penetration", a_, b_} + rest),
              lasting(Arguments{"penetration", a_, b_, "--points", "vertices"} + rest));
    const Outcome outcome = run_program(
        Arguments{"query", "--json", folder_.path("contacts"), "separation", a_, b_} + rest);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json::parse(folder_.read("contacts")).at("query"), "separation");
}

TEST_F(QueryLine, PlacesOfAFieldAreGivenOneByOneOrInARow) {
    const Arguments field{"distance-field", a_, b_};
    const Json expected =
        lasting(field + Arguments{"-d", "0.1", "--at", "0.2,0.2", "--at", "0.5,0.5"});
    ASSERT_EQ(expected.at("points").size(), 2U);
    for (const Arguments& words :
         {field + Arguments{"-d", "0.1", "--at", "0.2,0.2", "0.5,0.5"},
          Arguments{"-d", "0.1", "--at", "0.2,0.2", "0.5,0.5"} + field,
          Arguments{"--at", "0.2,0.2", "-d", "0.1", "--at=0.5,0.5"} + field}) {
        EXPECT_EQ(lasting(words), expected) << command_line(words);
    }
}

TEST_F(QueryLine, PosesMayHaveSpaces) {
    const Arguments line{"separation", a_, b_, "-d", "0.1", "--pose-b"};
    EXPECT_EQ(lasting(line + Arguments{"5, 3, 10"}), lasting(line + Arguments{"5,3,10"}));
}

TEST_F(QueryLine, OneOutlineMayComeFromTheStandardInput) {
    const Json expected = lasting({"separation", a_, b_, "-d", "0.1", "--pose-b", "5,3,10"});
    const std::string hex = folder_.write(
        "hex",
        "0103000000010000000400000000000000000000000000000000000000000000000000F03F0000000000"
        "000000000000000000F03F000000000000F03F0000000000000000000000000000F03F");
    for (const std::string& file : {a_, b_, hex}) {
        for (const Arguments& files : {Arguments{"-", b_}, Arguments{a_, "-"}}) {
            const Arguments words = Arguments{"query", "--json", "-", "separation"} + files +
                                    Arguments{"-d", "0.1", "--pose-b", "5,3,10"};
            const Outcome outcome = run_program(words, {{}, {}, file});
            ASSERT_EQ(outcome.status, 0) << command_line(words) << '\n' << outcome.err;
            EXPECT_EQ(Json::parse(outcome.out).at("distance"), expected.at("distance"));
        }
    }
    expect_refused({"query", "separation", "-", "-"}, {"only one", "standard input"});
    const Outcome bad = run_program({"query", "separation", "-", b_},
                                    {{}, {}, folder_.write("bad", "POLYGON((0 0,1 0,x))")});
    EXPECT_EQ(bad.status, 2);
    EXPECT_NE(bad.err.find("standard input:1:18: expected a number"), std::string::npos) << bad.err;
}

TEST_F(QueryLine, WhatAFileHoldsBesidesPolygonsIsNoted) {
    const std::string mixed = folder_.write(
        "mixed.wkt",
        "GEOMETRYCOLLECTION (POINT (1 2), POLYGON ((0 0, 1 0, 1 1, 0 1)), POINT (3 4))");
    const Outcome outcome = run_program({"query", "intersection-test", mixed, b_});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "nearfield: " + mixed + ": skipped what holds no area: POINT (2)\n");
    EXPECT_EQ(run_program({"query", "intersection-test", a_, b_}).err, "");
}

TEST_F(QueryLine, ExactQueriesNeedNoTolerance) {
    for (const char* const kind : {"separation", "closest-point"}) {
        const Json exact = lasting({kind, a_, b_, "--pose-b", "5,3,10"});
        const Json stated = lasting({kind, a_, b_, "--pose-b", "5,3,10", "-d", "0.1"});
        ASSERT_TRUE(exact.is_object() && stated.is_object());
        for (const char* const key : {"distance", "direction", "feature_a", "feature_b"}) {
            EXPECT_EQ(exact.at(key), stated.at(key)) << kind << ' ' << key;
        }
        EXPECT_EQ(exact.at("tolerance"), 0.001) << "a thousandth of the squares' side";
        const Json far = lasting({kind, a_, b_, "--pose-b", "9e11,3,10"});
        EXPECT_GT(far.at("tolerance"), 0.001);
        // Curves have to be tessellated somehow.
        const std::string disc =
            folder_.write("disc.path", "M 1 0 A 1 1 0 1 1 -1 0 A 1 1 0 1 1 1 0 Z");
        expect_refused({"query", kind, disc, b_}, {"--deviation"});
        const Json curved = lasting({kind, disc, b_, "--pose-b", "5,3,10", "--deviation", "0.01"});
        EXPECT_GE(curved.at("tolerance"), 0.04);
        EXPECT_NEAR(curved.at("distance"),
                    lasting({kind, disc, b_, "--pose-b", "5,3,10", "-d", "1e-4"}).at("distance"),
                    0.011);
    }
}

TEST_F(QueryLine, TimesAreThoseOfWhatTookPlace) {
    for (const char* const technique : {"cpu", "compute"}) {
        const Json times = answer({"query", "penetration", a_, b_, "--pose-b", "0.3,0.2,5", "-d",
                                   "0.1", "--technique", technique})
                               .at("timings_ms");
        const bool on_device = std::string(technique) == "compute";
        for (const char* const key : {"record", "device", "passes"}) {
            EXPECT_EQ(times.contains(key), on_device) << technique << ' ' << key << times;
        }
        for (const char* const key : {"plan", "decode", "total"}) {
            EXPECT_TRUE(times.contains(key)) << technique << ' ' << key << times;
        }
    }
}

TEST_F(QueryLine, EveryKindTakesWhatWasTakenOfEveryKind) {
    // Without effect on some kinds, whose help does not list them.
    const Arguments all{"-d",       "0.1",      "--strategy", "depth",  "--boxes",
                        "oriented", "--height", "2",          "--tiles"};
    for (const char* kind : {"penetration", "contacts", "intersection", "separation",
                             "closest-point", "distance-field", "intersection-test",
                             "time-of-impact", "separation-vector", "containment"}) {
        const Json json = lasting(Arguments{kind, a_, b_, "--pose-b", pose_} + all);
        ASSERT_TRUE(json.is_object()) << kind;
        EXPECT_EQ(json.at("query"), kind);
        EXPECT_EQ(json.contains("strategy"), std::string(kind) == "intersection");
    }
    expect_refused(squares("separation") + Arguments{"-d", "1", "--strategy", "magic"},
                   {"--strategy", "magic", "stencil"});
}

TEST_F(QueryLine, KindsThatAreMissingOrUnknownAreRefusedWithTheirNames) {
    const std::string names =
        "penetration, contacts, intersection, separation, closest-point, distance-field, "
        "intersection-test, time-of-impact, separation-vector, containment";
    for (const Arguments& words :
         {Arguments{}, Arguments{"-d", "1"}, Arguments{"--json"}, Arguments{"--tiles"},
          Arguments{"-d", "1", "--", "--tiles", "penetration", a_}}) {
        expect_refused(Arguments{"query"} + words, {"kind is required", names});
    }
    for (const Arguments& words :
         {Arguments{"depth"}, Arguments{"depth", a_, b_, "-d", "1"},
          Arguments{"-d", "1", "depth", a_, b_}, Arguments{"--frobnicate", "depth", a_, b_}}) {
        expect_refused(Arguments{"query"} + words, {"\"depth\" is none of the kinds", names});
    }
    expect_refused({"query", a_, "penetration", b_, "-d", "1"}, {a_, "is none of the kinds"});
}

TEST_F(QueryLine, OptionsOfOtherKindsAreRefusedWhereverTheyStand) {
    const std::vector<std::pair<Arguments, std::string>> foreign{
        {{"--points", "vertices"}, "penetration"},
        {{"--kind", "volume-volume"}, "intersection"},
        {{"--normals", "gradient"}, "contacts"},
        {{"--contact-distance", "1"}, "contacts and time-of-impact"},
        {{"--rect", "0,0,1,1"}, "distance-field"},
        {{"--sign", "color"}, "distance-field"},
        {{"--gradient", "blended"}, "distance-field"},
        {{"--gradient-field", folder_.path("g.npy")}, "distance-field"},
        {{"--features", folder_.path("f.npy")}, "distance-field"},
        {{"--field", folder_.path("v.npy")}, "distance-field"},
        {{"--show", "voronoi"}, "distance-field"},
        {{"--at", "0,0"}, "distance-field"},
        {{"--end-pose-a", "0,0,0"}, "time-of-impact"},
        {{"--end-pose-b", "0,0,0"}, "time-of-impact"},
        {{"--time-bound", "1"}, "time-of-impact"},
        {{"--most-steps", "5"}, "time-of-impact"},
        {{"--most-work", "5"}, "separation-vector"}};
    for (const auto& [option, owner] : foreign) {
        const std::string message =
            option.front() + ": belongs to " + owner + ", not to separation";
        const Arguments line{"separation", a_, b_, "-d", "1"};
        expect_refused(Arguments{"query"} + line + option, {message});
        expect_refused(Arguments{"query"} + option + line, {message});
        const std::string joined = option.front() + '=' + option.back();
        expect_refused(Arguments{"query"} + line + Arguments{joined}, {message});
    }
}

TEST_F(QueryLine, WhatIsMissingTooMuchOrGivenTwiceIsRefusedByName) {
    const Arguments line = squares("penetration");
    expect_refused(line, {"-d", "required"});
    expect_refused({"query", "penetration", a_, "-d", "1"}, {"B is required"});
    expect_refused({"query", "penetration", "-d", "1"}, {"A is required"});
    expect_refused(line + Arguments{"-d", "1", "contacts"}, {"contacts"});
    expect_refused(line + Arguments{"-d", "1", "--frobnicate"}, {"--frobnicate"});
    expect_refused({"query", "-d", "1", "penetration", a_, b_, "-d", "1"}, {"-d"});
}

}  // namespace
}  // namespace nearfield::test
