#include "example_program.hpp"
#include "expected_picture.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

struct Example {
    std::string name;
    std::string program;
    std::vector<std::string> arguments;
    Vector2 by;  ///< how far the mouse drags the star
    int width = 640;
    int height = 480;
    Vector2 label = {};  ///< as compare() expects it

    /// Prints an example in failure messages.
    friend std::ostream& operator<<(std::ostream& out, const Example& example) {
        return out << example.name;
    }
};

const Vector2 label_of_qt{140.0, 420.0};
/// Where the star comes to rest, and where it reaches into the hook.
const Vector2 to_rest{-2.2, -0.7};
const Vector2 into_the_hook{-1.7, 0.4};

std::vector<Example> every_example() {
    return {
        {"device_of_qt", NEARFIELD_QT_QUICK, {"--way=qt"}, into_the_hook, 640, 480, label_of_qt},
        {"own_device", NEARFIELD_QT_QUICK, {"--way=ours"}, to_rest, 640, 480, label_of_qt},
        {"own_image", NEARFIELD_QT_QUICK, {"--way=image"}, into_the_hook, 640, 480, label_of_qt},
        {"sdl", NEARFIELD_SDL_WINDOW, {"--frames=40"}, into_the_hook},
        {"sdl_resized",
         NEARFIELD_SDL_WINDOW,
         {"--frames=40", "--resize=800,600"},
         to_rest,
         800,
         600},
    };
}

class Examples : public testing::TestWithParam<Example> {
protected:
    /// Takes the picture after the star was dragged; expects no messages.
    [[nodiscard]] Pixels take_picture() const {
        const Example& example = GetParam();
        std::vector<std::string> arguments = example.arguments;
        const std::filesystem::path file = folder_.path() / "picture.png";
        arguments.push_back("--drag=" + std::to_string(example.by.x) + "," +
                            std::to_string(example.by.y));
        arguments.push_back("--screenshot=" + file.string());
        const ExampleOutcome outcome = run_example(example.program, arguments, folder_);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.messages, "");
        EXPECT_TRUE(outcome.validated);
        EXPECT_EQ(outcome.validation, "");
        return read_picture(file);
    }

private:
    test_support::Folder folder_;
};

TEST_P(Examples, ShowTheContactsOfTheCpu) {
    const Example& example = GetParam();
    const Pixels picture = take_picture();
    ASSERT_EQ(picture.width, example.width);
    ASSERT_EQ(picture.height, example.height);
    const examples::Scene scene = dragged_scene(example.by);
    const Comparison comparison = compare(picture, scene, contacts_by_cpu(scene), example.label);
    EXPECT_EQ(comparison.difference, "");
    EXPECT_GT(comparison.inside_markers, 100);
    EXPECT_GT(comparison.outside_markers, 100);
    EXPECT_GT(comparison.normals, 10);
    EXPECT_GT(comparison.filled[0], 10'000);
    EXPECT_GT(comparison.filled[1], 10'000);
    EXPECT_GT(comparison.background, 100'000);
    EXPECT_LT(comparison.lines, 10'000);
    if (example.label.x > 0.0) {
        EXPECT_NE(picture.at(20, example.height - 30), examples::background_color)
            << "no item of Qt Quick";
    }
}

INSTANTIATE_TEST_SUITE_P(Hosts, Examples, testing::ValuesIn(every_example()),
                         [](const auto& test) { return test.param.name; });

/// A run that cannot work prints a reason and exits with a status, not through a signal.
void expect_refused(const std::string& program, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment, int status,
                    const std::string& reason) {
    const test_support::Folder folder;
    const ExampleOutcome outcome = run_example(program, arguments, folder, environment);
    EXPECT_EQ(outcome.status, status) << outcome.messages;
    EXPECT_NE(outcome.messages.find(reason), std::string::npos) << outcome.messages;
}

TEST(ExampleErrors, ThereIsNoDisplay) {
    expect_refused(NEARFIELD_QT_QUICK, {}, {"DISPLAY="}, 1, "display");
    expect_refused(NEARFIELD_SDL_WINDOW, {}, {"DISPLAY=", "SDL_VIDEODRIVER=x11"}, 1,
                   "there is no display");
}

TEST(ExampleErrors, ThePlatformHasNoVulkan) {
    expect_refused(NEARFIELD_QT_QUICK, {}, {"QT_QPA_PLATFORM=offscreen"}, 1,
                   "there is no Vulkan instance on Qt's platform \"offscreen\"");
    expect_refused(NEARFIELD_SDL_WINDOW, {}, {"SDL_VIDEODRIVER=dummy"}, 1,
                   "there is no window for Vulkan");
}

TEST(ExampleErrors, TheArgumentsAreBad) {
    expect_refused(NEARFIELD_QT_QUICK, {"--way=theirs"}, {}, 2, "not \"theirs\"");
    expect_refused(NEARFIELD_QT_QUICK, {"--drag=far"}, {}, 2, "not \"far\"");
    expect_refused(NEARFIELD_QT_QUICK, {"--way=image"}, {}, 2, "needs --screenshot");
    expect_refused(NEARFIELD_SDL_WINDOW, {"--screenshot=a.png"}, {}, 2, "--frames");
}

}  // namespace
}  // namespace nearfield::test
