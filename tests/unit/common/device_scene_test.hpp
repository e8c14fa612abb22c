#pragma once

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tools/common/scene_runner.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace nearfield::tools {

using test::Random;

/// Random scenes, and a device with the technique compute.
class DeviceSceneTest : public testing::Test {
protected:
    void SetUp() override {
        Settings settings;
        settings.techniques = {.raster = false, .compute = true};
        settings.pipelines_on_demand = true;
        settings.memory_limit = memory_limit_;
        Expected<Context> context = Context::create_headless({}, settings);
        ASSERT_TRUE(context.has_value()) << context.error().text();
        context_.emplace(std::move(*context));
    }

    void limit_memory(std::uint64_t bytes) { memory_limit_ = bytes; }
    [[nodiscard]] Context& context() { return *context_; }

    static Pose any_pose(Random& random) {
        return {{random.between(-6.0, 6.0), random.between(-6.0, 6.0)}, random.between(-4.0, 4.0)};
    }

    /// Stars at random poses, every eighth one where another one is.
    static Scene random_scene(Random& random, std::size_t instances) {
        Scene scene;
        for (int i = 0; i < 4; ++i) {
            scene.shapes.push_back({.name = "star" + std::to_string(i),
                                    .rings = test::star(random, random.whole(3, 60), 0.3)});
        }
        for (std::size_t i = 0; i < instances; ++i) {
            scene.instances.push_back({.name = std::to_string(100 + i), .shape = i % 4});
            scene.instances.back().pose =
                i % 8 == 7 ? scene.instances[i - 4].pose : any_pose(random);
        }
        return scene;
    }

private:
    std::uint64_t memory_limit_ = Settings().memory_limit;
    std::optional<Context> context_;
};

}  // namespace nearfield::tools
