#include "cli_test.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

class Simulate : public CliTest {
protected:
    static Json run(const Arguments& options) { return answer(Arguments{"simulate"} + options); }
};

TEST_F(Simulate, TellsObjectsLinesEnergiesTimesAndPenetration) {
    const Json json = run({"cars", "--frames", "12", "--technique", "cpu"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("scene"), "cars");
    EXPECT_EQ(json.at("response"), "penalty");
    EXPECT_EQ(json.at("objects"), 18);
    EXPECT_EQ(json.at("lines"), 266);
    EXPECT_TRUE(json.at("worst_penetration").is_number());
    EXPECT_GT(json.at("energies").at("kinetic").get<double>(), 0.0);
    ASSERT_EQ(json.at("frames").size(), 12U);
    for (const Json& frame : json.at("frames")) {
        EXPECT_GT(frame.at("query_ms").get<double>(), 0.0);
        EXPECT_TRUE(frame.at("energies").at("total").is_number());
        EXPECT_TRUE(frame.at("worst_penetration").is_number());
    }
}

TEST_F(Simulate, PoursAsManyStarsAsAreAskedFor) {
    const Json json = run({"pour", "--bodies", "30", "--frames", "3", "--technique", "cpu"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("objects"), 31);
    EXPECT_EQ(json.at("lines"), 8 + 30 * 10);
}

TEST_F(Simulate, EveryRunIsTheSameButForTimes) {
    const Arguments links{"links", "--frames", "20", "--response", "backtracking"};
    const Json first = run(links);
    const Json second = run(links);
    ASSERT_TRUE(first.is_object());
    ASSERT_TRUE(second.is_object());
    for (std::size_t i = 0; i < 20; ++i) {
        const Json& frame = first.at("frames").at(i);
        EXPECT_EQ(frame.at("energies"), second.at("frames").at(i).at("energies")) << i;
        EXPECT_EQ(frame.at("worst_penetration"), 0.0) << i;
    }
}

TEST_F(Simulate, TellsTheClearanceOfAnItemInANest) {
    const Json json = run({"nest", "--frames", "90"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("scene"), "nest");
    EXPECT_EQ(json.at("technique"), "cpu");
    EXPECT_TRUE(json.at("device").is_null());
    EXPECT_TRUE(json.at("min_clearance").is_null());
    EXPECT_EQ(json.at("max_clearance"), 1.0);
    EXPECT_EQ(json.at("objects"), 37);  // the strip's edge is one of them
    EXPECT_EQ(json.at("paths_a_frame"), 1);
    EXPECT_EQ(json.at("poses_a_frame"), 1);
    ASSERT_EQ(json.at("frames").size(), 90U);
    double least = 1.0;
    bool is_free = false;
    for (const Json& frame : json.at("frames")) {
        const double distance = frame.at("distance").get<double>();
        least = std::min(least, distance);
        is_free |= distance > 0.0;
        EXPECT_EQ(frame.at("free_paths"), distance > 0.0 ? 1 : 0);
        EXPECT_LE(distance, 1.0);
        EXPECT_EQ(frame.at("instance").is_null(), distance == 1.0);
        EXPECT_EQ(frame.at("point").is_null(), frame.at("direction").is_null());
    }
    EXPECT_EQ(json.at("least_clearance"), least);
    EXPECT_LT(least, 0.0);
    EXPECT_TRUE(is_free);
}

TEST_F(Simulate, TellsTheClearancesOfThousandsOfPaths) {
    const Json json = run({"robots", "--frames", "3", "--threads", "2"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("lines"), 1450);  // of twelve islands, and the vehicle
    EXPECT_EQ(json.at("min_clearance"), 0.0);
    EXPECT_EQ(json.at("paths_a_frame"), 2000);
    EXPECT_EQ(json.at("poses_a_frame"), 80000);
    ASSERT_EQ(json.at("frames").size(), 3U);
    for (const Json& frame : json.at("frames")) {
        EXPECT_GT(frame.at("query_ms").get<double>(), 0.0);
        EXPECT_GT(frame.at("distance").get<double>(), 0.0);
        EXPECT_GT(frame.at("free_paths").get<int>(), 0);
        EXPECT_LT(frame.at("free_paths").get<int>(), 2000);
    }
}

TEST_F(Simulate, DrawsScenesOfClearances) {
    for (const std::string scene : {"nest", "robots"}) {
        const Outcome outcome = run_program({"simulate", scene, "--frames", "2", "--every", "2",
                                             "--image", folder_.path(scene + "_%d.png")});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("paths free"), std::string::npos) << outcome.out;
        const auto files = folder_.contents();
        ASSERT_TRUE(files.contains(scene + "_2.png"));
        EXPECT_FALSE(files.contains(scene + "_1.png"));
        EXPECT_NE(files.at(scene + "_0.png"), files.at(scene + "_2.png"));
    }
}

TEST_F(Simulate, RefusesWhatDoesNotApplyToClearances) {
    for (const std::string scene : {"nest", "robots"}) {
        const Arguments simulate{"simulate", scene, "--frames", "1"};
        for (const auto& [option, value] :
             std::vector<std::pair<std::string, std::string>>{{"--response", "penalty"},
                                                              {"--bodies", "5"},
                                                              {"--tolerance", "0.1"},
                                                              {"--boxes", "oriented"},
                                                              {"--height", "3"},
                                                              {"--memory-limit", "64"},
                                                              {"--technique", "raster"}}) {
            expect_refused(simulate + Arguments{option, value},
                           {option, "does not apply to " + scene});
        }
        expect_refused(simulate + Arguments{"--field"}, {"--field", "does not apply to " + scene});
        expect_refused(simulate + Arguments{"--image", folder_.path("no/such/%d.png")},
                       {"no/such/0.png", "cannot be written"});
    }
}

TEST_F(Simulate, DrawsTheFramesThatAreAskedFor) {
    const Outcome outcome = run_program({"simulate", "wavy", "--frames", "5", "--every", "2",
                                         "--field", "--image", folder_.path("wavy_%03d.png")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("2, 200"), std::string::npos) << outcome.out;
    const auto files = folder_.contents();
    for (const char* name : {"wavy_000.png", "wavy_002.png", "wavy_004.png", "wavy_005.png"}) {
        ASSERT_TRUE(files.contains(name)) << name;
        EXPECT_EQ(files.at(name).substr(1, 3), "PNG");
    }
    EXPECT_FALSE(files.contains("wavy_001.png"));
    EXPECT_NE(files.at("wavy_000.png"), files.at("wavy_005.png"));
}

TEST_F(Simulate, APatternWithoutANumberKeepsTheLastFrame) {
    ASSERT_EQ(
        run_program({"simulate", "cars", "--frames", "2", "--image", folder_.path("100%%.png")})
            .status,
        0);
    EXPECT_TRUE(folder_.contents().contains("100%.png"));
}

TEST_F(Simulate, RefusesWhatItCannotDoBeforeItStarts) {
    const Arguments simulate{"simulate"};
    expect_refused(simulate + Arguments{"planets"},
                   {"planets", "map, gears, links, cars, wavy", "nest, robots"});
    expect_refused(simulate, {"scene"});
    expect_refused(simulate + Arguments{"map", "--frames", "0"}, {"--frames"});
    expect_refused(simulate + Arguments{"map", "--frames", "-3"}, {"--frames"});
    expect_refused(simulate + Arguments{"map", "--response", "magic"}, {"--response", "magic"});
    expect_refused(simulate + Arguments{"map", "--technique", "magic"}, {"--technique", "magic"});
    expect_refused(simulate + Arguments{"map", "-d", "0"}, {"-d"});
    expect_refused(simulate + Arguments{"map", "--bodies", "5"}, {"--bodies", "pour", "map"});
    expect_refused(simulate + Arguments{"pour", "--bodies", "0"}, {"--bodies"});
    expect_refused(simulate + Arguments{"map", "--image", folder_.path("no/such/%d.png")},
                   {"no/such/0.png", "cannot be written"});
    expect_refused(simulate + Arguments{"map", "--image", folder_.path("%s.png")},
                   {"--image", "%"});
    expect_refused(simulate + Arguments{"map", "--image", folder_.path("%d%d.png")},
                   {"--image", "more than one"});
    expect_refused(simulate + Arguments{"map", "--video", folder_.path("no/such.mp4")},
                   {"no/such.mp4", "cannot be written"});
    expect_refused(simulate + Arguments{"map", "--json", folder_.path("no/such.json")},
                   {"no/such.json", "cannot be written"});
    expect_refused(simulate + Arguments{"overlap", "--response", "backtracking", "--json",
                                        folder_.path("a.json")},
                   {"overlap", "backtracking"});
}

TEST_F(Simulate, ThePapersTablesAreNoneOfAScene) {
    expect_refused({"bench", "--paper", "--scene", folder_.path("scene.json")}, {"--paper"});
    expect_refused({"bench", "--paper", "--filter", "gears"}, {"--paper"});
    expect_refused({"bench", "--curves", folder_.path("curves.png")}, {"--curves", "--paper"});
    expect_refused({"bench", "--paper", "--curves", folder_.path("no/such.png")},
                   {"no/such.png", "cannot be written"});
}

TEST_F(Simulate, MakesAVideoOfAllFrames) {
    const Outcome outcome =
        run_program({"simulate", "wavy", "--frames", "3", "--video", folder_.path("wavy.mp4")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto files = folder_.contents();
    ASSERT_TRUE(files.contains("wavy.mp4"));
    // The start of such a file, and the number of frames in it: the initial state and 3 more.
    const std::string& video = files.at("wavy.mp4");
    EXPECT_EQ(video.substr(4, 4), "ftyp");
    const std::size_t sizes = video.find("stsz");
    ASSERT_NE(sizes, std::string::npos);
    EXPECT_EQ(static_cast<unsigned char>(video.at(sizes + 15)), 4U);
}

TEST_F(Simulate, WithoutFfmpegAVideoIsRefusedByName) {
    Surroundings surroundings;
    surroundings.environment = {{"PATH", folder_.path("")}};
    const Outcome outcome = run_program(
        {"simulate", "cars", "--frames", "2", "--video", folder_.path("cars.mp4")}, surroundings);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("ffmpeg"), std::string::npos) << outcome.err;
    EXPECT_FALSE(folder_.contents().contains("cars.mp4"));
}

}  // namespace
}  // namespace nearfield::test
