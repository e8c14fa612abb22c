#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tests/support/techniques.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using namespace simulation;

/// A whole scene and the simulated duration: until it has been in contact for a while.
struct SceneRun {
    Scene (*make)();
    Response response;
    int frames;
};

/// The positions of all bodies.
std::vector<Vector2> vertices_of(const simulation::World& world) {
    std::vector<Vector2> vertices;
    for (const auto& body : world.scene().bodies) {
        for (const Ring& ring : body->rings()) {
            for (const Vector2& vertex : ring) {
                vertices.push_back(simulation::placed(body->pose(), vertex));
            }
        }
    }
    return vertices;
}

/// The final positions of the bodies, and their energy at every frame.
struct Course {
    std::vector<Vector2> vertices;
    std::vector<double> energies;
    std::size_t contacts = 0;
};

Course follow(const SceneRun& run, Technique technique) {
    simulation::World world(simulation_context(), run.make(), run.response, technique);
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
    // Records differ by less than d/1000, and so do resting positions of contacts. Motion after a
    // collision carries the difference along, and the next collision amplifies it, so eventually
    // any two runs of such a scene diverge. In the duration simulated here, bodies collide a few
    // times, and the difference must stay invisible to queries at the tolerance: half the
    // tolerance, five hundred times the initial difference.
    const double tolerance = 0.5 * run.make().tolerance;
    for (const Technique technique : any_technique) {
        if (technique == Technique::cpu) {
            continue;
        }
        const Course other = follow(run, technique);
        ASSERT_EQ(other.vertices.size(), first.vertices.size());
        double apart = 0.0;
        for (std::size_t i = 0; i < first.vertices.size(); ++i) {
            apart = std::max(apart, simulation::length(other.vertices[i] - first.vertices[i]));
        }
        EXPECT_LE(apart, tolerance) << to_string(technique);
        RecordProperty(to_string(technique), std::to_string(apart));
    }
}

constexpr SceneRun runs[] = {
    {simulation::map_scene, Response::penalty, 32},
    {simulation::map_scene, Response::backtracking, 80},
    {simulation::gears_scene, Response::penalty, 36},
    {simulation::gears_scene, Response::backtracking, 40},
    {simulation::links_scene, Response::penalty, 16},
    {simulation::links_scene, Response::backtracking, 20},
    {simulation::cars_scene, Response::penalty, 110},
    {simulation::cars_scene, Response::backtracking, 110},
    {simulation::wavy_scene, Response::penalty, 100},
    {simulation::wavy_scene, Response::backtracking, 140},
    {simulation::overlap_scene, Response::penalty, 30},
};

std::string name_of(const testing::TestParamInfo<SceneRun>& info) {
    return info.param.make().name +
           (info.param.response == Response::penalty ? "_penalty" : "_backtracking");
}

INSTANTIATE_TEST_SUITE_P(All, SceneRuns, testing::ValuesIn(runs), name_of);

}  // namespace
}  // namespace nearfield::test
