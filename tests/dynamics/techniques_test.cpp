#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tools/scenes/scenes.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using namespace dynamics;

/// A whole scene and for how long it is followed: until it has been in contact for a while.
struct SceneRun {
    Scene (*make)();
    Response response;
    int frames;
};

/// The numbers that say where every body is.
std::vector<Vector2> vertices_of(const World& world) {
    std::vector<Vector2> vertices;
    for (const auto& body : world.scene().bodies) {
        for (const Ring& ring : body->rings()) {
            for (const Vector2& vertex : ring) {
                vertices.push_back(placed(body->pose(), vertex));
            }
        }
    }
    return vertices;
}

/// Where the bodies are at the end, and what they held of energy at every frame.
struct Course {
    std::vector<Vector2> vertices;
    std::vector<double> energies;
    std::size_t contacts = 0;
};

Course follow(const SceneRun& run, Technique technique) {
    World world(simulation_context(), run.make(), run.response, technique);
    Course course;
    for (int frame = 0; frame < run.frames; ++frame) {
        const FrameReport report = world.advance();
        course.energies.push_back(report.energies.total());
        course.contacts += report.contacts;
    }
    course.vertices = vertices_of(world);
    return course;
}

class SceneRuns : public testing::TestWithParam<SceneRun> {};

TEST_P(SceneRuns, AreTheSameAgainAndWithinToleranceByEveryTechnique) {
    const SceneRun& run = GetParam();
    const Course first = follow(run, Technique::cpu);
    ASSERT_GT(first.contacts, 10U) << "without contact there is nothing to compare";
    const Course again = follow(run, Technique::cpu);
    EXPECT_EQ(again.vertices, first.vertices);
    EXPECT_EQ(again.energies, first.energies);
    // Records differ by less than d/1000, and so does where a contact comes to rest. What moves on
    // from a collision carries the difference along, and the next collision makes more of it: in
    // the end any two courses of such a scene part. For as long as these are followed, bodies
    // collide a few times, and the difference has to stay where no query of the tolerance sees it:
    // half the tolerance, five hundred times what it began with.
    const double tolerance = 0.5 * run.make().tolerance;
    for (const Technique technique :
         {Technique::automatic, Technique::compute, Technique::raster}) {
        const Course other = follow(run, technique);
        ASSERT_EQ(other.vertices.size(), first.vertices.size());
        double apart = 0.0;
        for (std::size_t i = 0; i < first.vertices.size(); ++i) {
            apart = std::max(apart, length(other.vertices[i] - first.vertices[i]));
        }
        EXPECT_LE(apart, tolerance) << to_string(technique);
        RecordProperty(to_string(technique), std::to_string(apart));
    }
}

constexpr SceneRun runs[] = {
    {scenes::map_scene, Response::penalty, 32},
    {scenes::map_scene, Response::backtracking, 80},
    {scenes::gears_scene, Response::penalty, 36},
    {scenes::gears_scene, Response::backtracking, 40},
    {scenes::links_scene, Response::penalty, 16},
    {scenes::links_scene, Response::backtracking, 20},
    {scenes::cars_scene, Response::penalty, 110},
    {scenes::cars_scene, Response::backtracking, 110},
    {scenes::wavy_scene, Response::penalty, 100},
    {scenes::wavy_scene, Response::backtracking, 140},
    {scenes::overlap_scene, Response::penalty, 30},
};

std::string name_of(const testing::TestParamInfo<SceneRun>& info) {
    return info.param.make().name +
           (info.param.response == Response::penalty ? "_penalty" : "_backtracking");
}

INSTANTIATE_TEST_SUITE_P(All, SceneRuns, testing::ValuesIn(runs), name_of);

}  // namespace
}  // namespace nearfield::test
