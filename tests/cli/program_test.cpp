#include "cli_test.hpp"

namespace nearfield::test {
namespace {

class Device : public CliTest {};

TEST_F(Device, InfoListsTheOneThatAnswers) {
    const Json json = answer(squares("penetration") + Arguments{"-d", "0.1"});
    ASSERT_TRUE(json.is_object());
    const Outcome info = run_program({"info"});
    EXPECT_EQ(info.status, 0) << info.err;
    EXPECT_EQ(info.out.rfind("nearfield ", 0), 0U) << info.out;
    EXPECT_NE(info.out.find(json.at("device").get<std::string>()), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("usable"), std::string::npos) << info.out;
}

TEST_F(Device, WithoutADriverTheExitStatusIs3AndNothingIsWritten) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1]]]}},
        "instances": {"A": {"shape": "square"}},
        "queries": [{"query": "penetration", "a": "A", "b": "A", "tolerance": 0.1,
                     "technique": "compute"}]})");
    const Arguments outputs{"--json", folder_.path("answer.json")};
    const auto before = folder_.contents();
    for (const Arguments& arguments :
         {squares("penetration") + Arguments{"-d", "0.1", "--image", folder_.path("i.png")} +
              outputs,
          squares("penetration") + Arguments{"-d", "0.1", "--json", "-"},
          Arguments{"bench", "--scene", scene} + outputs, Arguments{"info"}}) {
        const Outcome outcome = run_program(arguments, without_driver());
        EXPECT_EQ(outcome.status, 3) << command_line(arguments);
        EXPECT_NE(outcome.err.find("driver"), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out.find('{'), std::string::npos) << outcome.out;
        EXPECT_TRUE(folder_.contents() == before) << command_line(arguments);
    }
}

TEST_F(Device, WithoutADriverTheCpuAnswersWhereItMay) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1]]]}},
        "instances": {"A": {"shape": "square"}},
        "queries": [{"query": "penetration", "a": "A", "b": "A", "tolerance": 0.1}]})");
    const auto run = [](const Arguments& arguments, const char* technique) {
        return run_program(arguments + Arguments{"--technique", technique, "--json", "-"},
                           without_driver());
    };
    const Arguments query{"query", "separation", a_, b_, "-d", "0.1"};
    for (const Arguments& command :
         {query, Arguments{"scene", scene}, Arguments{"bench", "--scene", scene, "--frames", "2"},
          Arguments{"simulate", "gears", "--frames", "2"}}) {
        for (const char* technique : {"cpu", "automatic"}) {
            SCOPED_TRACE(command_line(command) + ", " + technique);
            const Outcome outcome = run(command, technique);
            ASSERT_EQ(outcome.status, 0) << outcome.err;
            EXPECT_TRUE(Json::parse(outcome.out).at("device").is_null());
            EXPECT_EQ(outcome.err.find("without a device") != std::string::npos,
                      technique == std::string("automatic"))
                << outcome.err;
        }
        EXPECT_EQ(run(command, "raster").status, 3);
    }
    EXPECT_EQ(Json::parse(run(query, "cpu").out).at("technique"), "cpu");
}

TEST_F(Device, WithTheTechniqueCpuNoDriverIsAsked) {
    Arguments query{"query", "penetration", a_, b_, "-d", "0.1", "--technique", "cpu"};
    const Outcome with = run_program(query + Arguments{"--json", "-"});
    const Outcome without = run_program(query + Arguments{"--json", "-"}, without_driver());
    ASSERT_EQ(with.status, 0) << with.err;
    Json of_both[] = {Json::parse(with.out), Json::parse(without.out)};
    for (Json& json : of_both) {
        EXPECT_TRUE(json.at("device").is_null());
        json.erase("timings_ms");
    }
    EXPECT_EQ(of_both[0], of_both[1]);
}

TEST_F(Device, WithTheTechniqueCpuNoVulkanLoaderIsOpened) {
    const Surroundings telling{{{"LD_DEBUG", "files"}}, {}};  // for the dynamic linker
    const auto loads_vulkan = [&](const char* technique) {
        const Outcome outcome = run_program(
            {"query", "penetration", a_, b_, "-d", "0.1", "--technique", technique}, telling);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.err.find("libcairo"), std::string::npos) << "the linker says nothing";
        return outcome.err.find("libvulkan") != std::string::npos;
    };
    EXPECT_FALSE(loads_vulkan("cpu"));
    EXPECT_TRUE(loads_vulkan("raster"));
}

TEST_F(Device, TheResultSaysWhichTechniqueAnswered) {
    const Arguments more{"-d", "0.1", "--pose-b", "0.6,0,5"};
    for (const char* type : {"penetration", "contacts", "intersection", "separation",
                             "closest-point", "distance-field"}) {
        for (const char* technique : {"raster", "compute", "cpu"}) {
            EXPECT_EQ(answer(squares(type, technique) + more).at("technique"), technique);
        }
        EXPECT_NE(answer(squares(type, "automatic") + more).at("technique"), "automatic");
    }
    // A strategy is a way of drawing, so naming one selects the raster.
    Arguments unnamed = squares("intersection", "raster") + more + Arguments{"--strategy", "depth"};
    const auto technique = std::find(unnamed.begin(), unnamed.end(), "--technique");
    ASSERT_NE(technique, unnamed.end());
    unnamed.erase(technique, technique + 2);
    EXPECT_EQ(answer(unnamed).at("technique"), "raster");
}

class LocalizationOptions : public CliTest {};

TEST_F(LocalizationOptions, AreCountedInTheAnswer) {
    const Arguments query =
        squares("penetration") + Arguments{"-d", "0.1", "--pose-b", "0.5,0.5,0"};
    const Json usual = answer(query);
    const Json flat = answer(query + Arguments{"--height", "0", "--boxes", "oriented"});
    ASSERT_FALSE(usual.is_null() || flat.is_null());
    EXPECT_EQ(flat.at("localization").at("nodes_evaluated"), 2);
    EXPECT_EQ(flat.at("localization").at("edges_kept"), 4);
    EXPECT_GT(usual.at("localization").at("nodes_evaluated"), 2);
    EXPECT_EQ(flat.at("deepest").at("depth"), usual.at("deepest").at("depth"));
    expect_refused(query + Arguments{"--boxes", "round"}, {"--boxes", "round", "oriented"});
    expect_refused(query + Arguments{"--height", "33"}, {"--height"});
}

}  // namespace
}  // namespace nearfield::test
