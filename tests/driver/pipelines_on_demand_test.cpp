#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>
#include <tests/support/pair_tables.hpp>
#include <tests/support/techniques.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace nearfield::test {
namespace {

/// When a context makes its pipelines: Settings::pipelines_on_demand.
class PipelinesOnDemand : public ::testing::Test {
protected:
    void make(bool on_demand) {
        driver_.forget_calls();
        Settings settings;
        settings.pipelines_on_demand = on_demand;
        context_.emplace(*Context::create(driver_.host(), settings));
        const std::vector<Ring> square{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}};
        shape_ = *context_->add_shape(square);
    }

    /// Pipelines that have been made since the last call of it.
    [[nodiscard]] std::ptrdiff_t count_made() {
        const std::ptrdiff_t count = std::count_if(
            driver_.calls().begin(), driver_.calls().end(), [](std::string_view call) {
                return call == "vkCreateComputePipelines" || call == "vkCreateGraphicsPipelines";
            });
        driver_.forget_calls();
        return count;
    }

    /// Kinds of calls, of which each needs pipelines that the ones before it do not.
    [[nodiscard]] std::vector<std::function<Status()>> calls() {
        const Instance a{shape_, {}};
        const Instance b{shape_, {{1.0, 1.0}, 0.0}};
        const auto run = [this](const auto& query) {
            return [this, query] {
                Batch batch;
                static_cast<void>(batch.add(query));
                Results results;
                const Status status = context_->run(batch, results);
                return status.ok() ? std::visit([](const auto& one) { return one.status; },
                                                results.results.front())
                                   : status;
            };
        };
        PenetrationQuery penetration{a, b, 0.1};
        penetration.technique = Technique::compute;
        PenetrationQuery resident = penetration;
        resident.on_device = true;
        IntersectionQuery intersection{a, b, 0.1};
        intersection.technique = Technique::compute;
        DistanceFieldQuery field{a, b, 0.1};
        field.technique = Technique::compute;
        std::vector<std::function<Status()>> calls{
            run(penetration),
            run(resident),
            run(intersection),
            run(field),
            [this, a, b] {
                nearfield::World world = *nearfield::World::create(*context_);
                for (const Instance& one : {a, b}) {
                    static_cast<void>(world.add({.shape = one.shape, .pose = one.pose}));
                }
                PairTable<PenetrationQuery> table({.tolerance = 0.1}, on_device);
                return world.update(table);
            },
            [this, a] {
                nearfield::World world = *nearfield::World::create(*context_);
                static_cast<void>(world.add({.shape = a.shape, .pose = a.pose}));
                const std::vector<Segment> segments(1);
                std::vector<RayHit> hits(1);
                return world.cast_rays(segments, hits, {.technique = Technique::compute});
            },
            [this, a] {
                nearfield::World world = *nearfield::World::create(*context_);
                static_cast<void>(world.add({.shape = a.shape, .pose = a.pose}));
                const std::vector<Vector2> points(1);
                std::vector<NearestHit> hits(1);
                return world.find_nearest({}, points, hits, {.technique = Technique::compute});
            },
            [this, a] {
                nearfield::World world = *nearfield::World::create(*context_);
                static_cast<void>(world.add({.shape = a.shape, .pose = a.pose}));
                const std::vector<Pose> poses(1);
                std::vector<std::uint8_t> meets(1);
                return world.test_poses(a.shape, poses, meets, {.technique = Technique::compute});
            }};
        if (has_raster) {
            penetration.technique = Technique::raster;
            calls.push_back(run(penetration));
        }
        return calls;
    }

    test_support::MockDriver driver_;
    std::optional<Context> context_;
    ShapeHandle shape_;
};

TEST_F(PipelinesOnDemand, AreMadeByTheFirstCallThatNeedsThem) {
    make(true);
    EXPECT_EQ(count_made(), 0);
    std::size_t number = 0;
    for (const auto& call : calls()) {
        SCOPED_TRACE(number++);
        EXPECT_TRUE(call().ok());
        EXPECT_GT(count_made(), 0);
        EXPECT_TRUE(call().ok());
        EXPECT_EQ(count_made(), 0);
    }
}

TEST_F(PipelinesOnDemand, AreAllMadeAtOnceWithout) {
    make(false);
    EXPECT_GT(count_made(), 0);
    for (const auto& call : calls()) {
        EXPECT_TRUE(call().ok());
    }
    EXPECT_EQ(count_made(), 0);
}

TEST_F(PipelinesOnDemand, AreMadeByTheNextCallIfTheDriverFails) {
    make(true);
    const std::vector<std::function<Status()>> all = calls();
    for (std::size_t number = 0; number < all.size(); ++number) {
        SCOPED_TRACE(number);
        const auto& call = all[number];
        const bool is_drawn = has_raster && number + 1 == all.size();
        driver_.fail(is_drawn ? "vkCreateGraphicsPipelines" : "vkCreateComputePipelines", 0,
                     VK_ERROR_OUT_OF_HOST_MEMORY, test_support::MockDriver::Failing::once);
        EXPECT_EQ(call().code(), StatusCode::out_of_memory);
        EXPECT_TRUE(call().ok());
    }
}

}  // namespace
}  // namespace nearfield::test
