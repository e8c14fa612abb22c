// Queries of all instances by the device: the same answers as those of the CPU.

#include <gtest/gtest.h>
#include <tests/unit/common/device_scene_test.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/world_report.hpp>
#include <tools/io/world_request.hpp>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

class DeviceScenes : public DeviceSceneTest {
protected:
    /// One query of each kind that the device answers.
    static void add_queries(Random& random, std::size_t count,
                            const std::optional<InstanceGroup>& against,
                            std::optional<std::size_t> except, Scene& scene) {
        WorldRequest request;
        request.against = against;
        request.except = except;
        request.shape = 1;
        for (std::size_t i = 0; i < count; ++i) {
            request.poses.push_back(any_pose(random));
        }
        add(request, scene);
        request.shape.reset();
        request.poses.clear();
        request.type = WorldQueryType::nearest;
        for (std::size_t i = 0; i < count; ++i) {
            request.points.push_back(any_pose(random).translation);
        }
        add(request, scene);
        request.kind = NearestKind::edges;
        request.max_distance = 0.5;
        add(request, scene);
        request.points.clear();
        request.type = WorldQueryType::rays;
        for (std::size_t i = 0; i < count; ++i) {
            request.segments.push_back(
                {any_pose(random).translation, any_pose(random).translation});
        }
        add(request, scene);
    }

    static void add(const WorldRequest& request, Scene& scene) {
        SceneQuery query;
        query.kind = name_of(request.type);
        query.world = request;
        scene.queries.push_back(std::move(query));
    }

    /// Runs a scene as the device answers it, and compares with the CPU.
    void compare(Scene scene, FrameInput input = FrameInput::all, int frames = 1) {
        set_technique(scene, Technique::compute);
        const std::vector<std::string> found = records_of(scene, input, frames);
        set_technique(scene, Technique::cpu);
        const std::vector<std::string> expected = records_of(scene, input, frames);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i], expected[i]) << "query " << i;
        }
    }

    std::vector<std::string> records_of(const Scene& scene, FrameInput input, int frames) {
        SceneRunner runner(scene, "scene", context());
        static_cast<void>(runner.run_frame(FrameInput::all));
        for (int frame = 1; frame < frames; ++frame) {
            static_cast<void>(runner.run_frame(input));
        }
        runner.require_results();
        const std::string asked = to_string(scene.queries.front().world->technique);
        EXPECT_EQ(runner.technique(), asked);
        EXPECT_EQ(runner.timings().device > 0.0, asked == "compute");
        std::vector<std::string> texts;
        for (const SceneAnswer& answer : runner.answers()) {
            texts.push_back(text_of(*answer.world, asked));
        }
        return texts;
    }

    /// All of an answer, its numbers exact, but for the technique.
    static std::string text_of(const WorldAnswer& answer, const std::string& technique) {
        std::ostringstream stream;
        JsonWriter json(stream);
        json.begin_object(JsonWriter::Layout::lines);
        write_world_answer(json, answer);
        json.end_object();
        std::string text = stream.str();
        const std::size_t place = text.find('"' + technique + '"');
        EXPECT_NE(place, std::string::npos) << text;
        return text.erase(place, technique.size() + 2);
    }
};

TEST_F(DeviceScenes, TheSceneOfTheDocumentsIsAnswered) {
    Scene scene = read_scene(NEARFIELD_TEST_DATA "/scenes/strip.json");
    set_technique(scene, Technique::compute);
    std::erase_if(scene.queries, [](const SceneQuery& query) {
        return !query.world || !technique_problem(*query.world).empty();
    });
    EXPECT_EQ(scene.queries.size(), 2U) << "of poses and of rays";
    compare(scene);
}

TEST_F(DeviceScenes, AnswersAreThoseOfTheCpu) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Scene scene = random_scene(random, 40);
        const InstanceGroup group{"some", {1, 2, 3, 5, 8, 13, 21, 34}};
        add_queries(random, 200, std::nullopt, std::nullopt, scene);
        add_queries(random, 200, group, std::nullopt, scene);
        add_queries(random, 200, std::nullopt, 3, scene);
        add_queries(random, 200, group, 8, scene);
        add_queries(random, 0, group, std::nullopt, scene);
        compare(scene);
    }
}

TEST_F(DeviceScenes, FramesAreThoseOfTheCpu) {
    Random random(20);
    Scene scene = random_scene(random, 30);
    add_queries(random, 100, std::nullopt, std::nullopt, scene);
    add_queries(random, 100, InstanceGroup{"some", {1, 4, 9}}, 4, scene);
    for (const FrameInput input : {FrameInput::all, FrameInput::poses, FrameInput::nothing}) {
        compare(scene, input, 4);
    }
}

TEST_F(DeviceScenes, SeveralWorldsAreThoseOfTheCpu) {
    // More groups than the categories of one world distinguish.
    Random random(30);
    Scene scene = random_scene(random, 70);
    for (std::size_t i = 0; i < 70; ++i) {
        add_queries(random, 3, InstanceGroup{std::to_string(100 + i), {i}}, std::nullopt, scene);
    }
    compare(scene);
}

class DeviceScenesWithLittleMemory : public DeviceScenes {
protected:
    DeviceScenesWithLittleMemory() { limit_memory(std::uint64_t{1} << 16U); }
};

TEST_F(DeviceScenesWithLittleMemory, ManyInputsAreAskedInParts) {
    Random random(40);
    Scene scene = random_scene(random, 20);
    add_queries(random, 5000, std::nullopt, std::nullopt, scene);
    compare(scene);
    compare(scene, FrameInput::poses, 2);
}

}  // namespace
}  // namespace nearfield::tools
