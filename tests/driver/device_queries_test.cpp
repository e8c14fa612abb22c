#include <nearfield/world_request.hpp>

#include <gtest/gtest.h>
#include <tests/driver/device_world.hpp>

#include <cstdint>

namespace nearfield::test {
namespace {

/// Rays, points and poses that the device is asked about.
class QueriesOfDevice : public DeviceWorld {
public:
    [[nodiscard]] Status submit() override { return world().submit(rays_, segments_, by_device_); }
    [[nodiscard]] Status ask() override {
        Status status = world().cast_rays(segments_, hits_, by_device_);
        if (!status.ok()) {
            return status;
        }
        status = world().submit(nearest_, {}, points_, by_device_);
        status = status.ok() ? nearest_.collect(near_) : status;
        return status.ok() ? world().test_poses(shape(), poses_, meets_, by_device_) : status;
    }

private:
    void enlarge() override {
        resize(3'000);
        add(10, 5000);
    }
    void forget() override {
        rays_ = {};
        nearest_ = {};
        world().trim();
    }
    void resize(std::size_t count) {
        segments_.resize(count, {{0.0, 0.0}, {1.0, 1.0}});
        hits_.resize(count);
        points_.resize(count, {0.2, 0.1});
        near_.resize(count);
        poses_.resize(count);
        meets_.resize(count);
    }

    const WorldOptions by_device_{.technique = Technique::compute};
    WorldRequest rays_;
    WorldRequest nearest_;
    std::vector<Segment> segments_{10, {{-2.0, 0.0}, {2.0, 0.1}}};
    std::vector<RayHit> hits_{10};
    std::vector<Vector2> points_{10, {0.2, 0.1}};
    std::vector<NearestHit> near_{10};
    std::vector<Pose> poses_{10};
    std::vector<std::uint8_t> meets_ = std::vector<std::uint8_t>(10);
};

std::unique_ptr<DeviceWorld> make() {
    return std::make_unique<QueriesOfDevice>();
}

TEST(DeviceQueriesOfDriver, NameFailingCallsLeakNothingAndWorkAfterwards) {
    expect_to_survive_failing_calls(make, [](DeviceWorld::Step step, auto& count) {
        EXPECT_EQ(count["vkQueueSubmit"], 3U);
        EXPECT_EQ(count["vkCreateBuffer"] > 0, step != DeviceWorld::Step::moved);
        EXPECT_EQ(count["vkUpdateDescriptorSets"] > 0, step != DeviceWorld::Step::moved);
    });
}

TEST(DeviceQueriesOfDriver, SayThatHostMemoryRunsOutAndWorkAfterwards) {
    expect_to_survive_scarce_memory(make);
}

/// As nothing of the context, rays that are still on the device leave nothing.
TEST(DeviceQueriesInFlight, AreWaitedForByTheirDestructor) {
    const auto queries = make();
    EXPECT_TRUE(queries->submit().ok());
    queries->expect_to_leave_nothing();
}

}  // namespace
}  // namespace nearfield::test
