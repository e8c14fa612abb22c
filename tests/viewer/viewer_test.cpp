#include <gtest/gtest.h>
#include <tests/hosts/example_program.hpp>
#include <tests/hosts/picture_file.hpp>
#include <tests/support/techniques.hpp>
#include <tools/common/library.hpp>
#include <tools/drawing/view.hpp>
#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/scenes.hpp>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

// As in the viewer.
constexpr int width = 1280;
constexpr int height = 760;
constexpr int panel = 330;

std::string to_words(const Vector2& from, const Vector2& to) {
    std::ostringstream words;
    words << from.x << ',' << from.y << ',' << to.x << ',' << to.y;
    return words.str();
}

class Viewer : public testing::Test {
protected:
    /// Takes the last frame; expects no messages from the viewer or the validation layers.
    [[nodiscard]] Pixels take_picture(std::vector<std::string> arguments) const {
        const std::filesystem::path file = folder_.path() / "picture.png";
        arguments.push_back("--screenshot=" + file.string());
        const ExampleOutcome outcome = run_example(NEARFIELD_VIEWER, arguments, folder_);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.messages, "");
        EXPECT_TRUE(outcome.validated);
        EXPECT_EQ(outcome.validation, "");
        return read_picture(file);
    }

    /// The number of different pixels of the scene, beside the panel.
    [[nodiscard]] static int differences(const Pixels& a, const Pixels& b) {
        int count = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = panel; x < width; ++x) {
                count += a.at(x, y) != b.at(x, y) ? 1 : 0;
            }
        }
        return count;
    }

    [[nodiscard]] static const examples::Color& pixel(const Pixels& picture, const Rectangle& world,
                                                      const Vector2& place) {
        const tools::View view(world, {{double{panel}, 0.0}, {double{width}, double{height}}});
        const Vector2 at = view.to_page(place);
        return picture.at(static_cast<int>(at.x), static_cast<int>(at.y));
    }

    test_support::Folder folder_;
};

TEST_F(Viewer, ABodyFollowsTheMouse) {
    const simulation::Scene scene = simulation::map_scene();
    const Vector2 from = scene.bodies[0]->center();
    const Vector2 to{4.4, 3.4};  // a corner without other motion
    const std::vector<std::string> quiet{"map", "--frames=30", "--show=none"};
    const Pixels before = take_picture({"map", "--frames=1", "--show=none"});
    const Pixels alone = take_picture(quiet);
    std::vector<std::string> dragging = quiet;
    dragging.push_back("--drag=" + to_words(from, to));
    const Pixels dragged = take_picture(dragging);

    const examples::Color of_body = pixel(before, scene.view, from);
    const examples::Color background = pixel(before, scene.view, to);
    ASSERT_NE(of_body, background);
    // Beside the mark of the drag, which is drawn over the body.
    const Vector2 beside{to.x - 0.15, to.y - 0.1};
    EXPECT_EQ(pixel(alone, scene.view, beside), background);
    EXPECT_EQ(pixel(dragged, scene.view, beside), of_body);
    EXPECT_GT(differences(alone, dragged), 10'000);
}

TEST_F(Viewer, ADeformableBodyIsPulledOut) {
    const simulation::Scene scene = simulation::wavy_scene();
    // The free side of the left bar, half-way up.
    const Ring& ring = scene.bodies[0]->rings().front();
    Vector2 from = ring.front();
    for (const Vector2& vertex : ring) {
        const double middle = scene.bodies[0]->center().y;
        const bool free_side = vertex.x > scene.bodies[0]->center().x;
        if (free_side && std::abs(vertex.y - middle) < std::abs(from.y - middle)) {
            from = vertex;
        }
    }
    from.x -= 0.05;
    const Vector2 to{from.x - 0.5, from.y};
    const std::vector<std::string> quiet{"wavy", "--frames=20", "--show=none"};
    const Pixels alone = take_picture(quiet);
    std::vector<std::string> dragging = quiet;
    dragging.push_back("--drag=" + to_words(from, to));
    const Pixels dragged = take_picture(dragging);
    EXPECT_GT(differences(alone, dragged), 2'000);
}

TEST_F(Viewer, AnItemOfTheNestFollowsTheMouseAndChangesItsColour) {
    Context context = tools::take(Context::create_cpu());
    const simulation::Nest nest(context);
    // The last item, a star about its position.
    const Vector2 from = nest.obstacles().back().pose.translation;
    const auto color_at = [&](const Vector2& to) {
        // Off the middle, which the mark of the deepest vertex may cover.
        return pixel(take_picture({"nest", "--frames=4", "--drag=" + to_words(from, to)}),
                     nest.view(), {to.x - 0.12, to.y - 0.12});
    };
    // Onto another item; and out of the strip, away from everything.
    const examples::Color overlapping = color_at(nest.obstacles()[1].pose.translation);
    const examples::Color clear = color_at({from.x, -1.5});
    EXPECT_GT(overlapping[0], overlapping[2] + 80) << "red";
    EXPECT_GT(clear[2], clear[0] + 40) << "green to blue";
}

TEST_F(Viewer, TheGoalOfTheRobotsCanBeDragged) {
    const Pixels alone = take_picture({"robots", "--frames=2"});
    const Pixels dragged =
        take_picture({"robots", "--frames=2", "--drag=" + to_words({22.5, 11.5}, {1.5, 6.0})});
    EXPECT_GT(differences(alone, dragged), 1'000);
}

TEST_F(Viewer, EachOverlayChangesThePicture) {
    const std::string by_device = has_raster ? "--technique=raster" : "--technique=compute";
    const std::vector<std::vector<std::string>> overlays{
        {"--show=none"},
        {"--show=depths"},
        {"--show=contacts"},
        {"--show=regions", by_device},
        {"--show=tiles", by_device},
        {"--show=samples", by_device, "--strategy=logic-op"},
        {"--show=none", "--field=distance"},
        {"--show=none", "--field=voronoi"},
        {"--show=none", "--field=gradient"}};
    std::vector<Pixels> pictures;
    for (std::vector<std::string> arguments : overlays) {
        arguments.insert(arguments.begin(), {"overlap", "--frames=1"});
        pictures.push_back(take_picture(arguments));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
            EXPECT_GT(differences(pictures[i], pictures.back()), 50)
                << overlays[i].back() << " and " << arguments.back();
        }
    }
}

TEST_F(Viewer, FitsAWindowThatIsResized) {
    const Pixels picture = take_picture({"overlap", "--frames=6", "--resize=900,620"});
    ASSERT_EQ(picture.width, 900);
    ASSERT_EQ(picture.height, 620);
    // Bodies in the middle of the area beside the panel, background in the last corner.
    const examples::Color& background = picture.at(899, 619);
    EXPECT_NE(picture.at((panel + 900) / 2, 310), background);
    EXPECT_EQ(picture.at(panel + 1, 1), background);
    EXPECT_NE(picture.at(1, 1), background);
}

/// A run that cannot work prints a reason and exits with a status, not through a signal.
void expect_viewer_refused(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment, int status,
                           const std::string& reason) {
    const test_support::Folder folder;
    const ExampleOutcome outcome = run_example(NEARFIELD_VIEWER, arguments, folder, environment);
    EXPECT_EQ(outcome.status, status) << outcome.messages;
    EXPECT_NE(outcome.messages.find(reason), std::string::npos) << outcome.messages;
}

TEST(ViewerErrors, TheArgumentsAreBad) {
    expect_viewer_refused({"planets"}, {}, 2, "\"planets\" is none of the scenes map, gears");
    expect_viewer_refused({"--response=magic"}, {}, 2, "\"magic\" is none of penalty");
    expect_viewer_refused({"--technique=magic"}, {}, 2, "magic");
    expect_viewer_refused({"--strategy=magic"}, {}, 2, "--strategy");
    expect_viewer_refused({"--field=magic"}, {}, 2, "\"magic\" is none of none, distance");
    expect_viewer_refused({"--show=magic"}, {}, 2, "\"magic\" is none of contacts");
    expect_viewer_refused({"-d", "0"}, {}, 2, "-d");
    expect_viewer_refused({"nest", "-d", "0.1"}, {}, 2, "-d: does not apply to nest");
    expect_viewer_refused({"--frames=0"}, {}, 2, "--frames");
    expect_viewer_refused({"--drag=0,0,1,1"}, {}, 2, "--frames");
    expect_viewer_refused({"--frames=1", "--drag=0,0"}, {}, 2, "not X0,Y0,X1,Y1");
    expect_viewer_refused({"--frames=1", "--screenshot=/no/such/a.png"}, {}, 2, "/no/such/a.png");
    expect_viewer_refused({"overlap", "--response=backtracking", "--frames=1"}, {}, 2,
                          "backtracking: overlap: ");
}

TEST(ViewerErrors, ThereIsNoDisplayOrNoVulkan) {
    expect_viewer_refused({}, {"DISPLAY=", "SDL_VIDEODRIVER=x11"}, 1, "there is no display");
    expect_viewer_refused({}, {"SDL_VIDEODRIVER=dummy"}, 3, "there is no window for Vulkan");
    expect_viewer_refused({}, {"VK_ICD_FILENAMES=/no/such.json", "VK_DRIVER_FILES=/no/such.json"},
                          3, "Vulkan");
}

}  // namespace
}  // namespace nearfield::test
