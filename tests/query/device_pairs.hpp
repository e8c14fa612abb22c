#pragma once

#include <tests/query/query_test.hpp>
#include <tests/support/host_gpu.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Shapes of all kinds.
inline std::vector<Rings> some_shapes(Random& random) {
    std::vector<Rings> shapes{star(random, 50, 0.5),
                              star(random, 7, 0.3),
                              comb(8),
                              with_holes(random, 5),
                              several_parts(random, 3),
                              spiral(2.0, 0.2, 60),
                              coast(random, 300, 0.3),
                              pentagram(),
                              needle(1e-6),
                              rectangle({-1.0, -1.0}, {1.0, 1.0}),
                              with_repeated_vertices(random, star(random, 20, 0.6), 0.3)};
    shapes.push_back(scaled_and_moved(star(random, 30, 0.5), 0.05, {100.0, -50.0}));
    shapes.push_back(scaled_and_moved(coast(random, 200, 0.3), 8.0, {0.0, 0.0}));
    return shapes;
}

/// How long a random history is, how many instances it starts with, and how far these scatter.
struct History {
    int steps;
    int instances;
    double extent;
};

/// A world whose pairs the device finds.
class DevicePairsTest : public QueryTest {
protected:
    void SetUp() override {
        Expected<World> made = World::create(context());
        ASSERT_TRUE(made.has_value());
        world_.emplace(std::move(*made));
    }
    void TearDown() override {
        world_.reset();
        for (const ShapeHandle shape : shapes_) {
            EXPECT_TRUE(context().remove_shape(shape).ok());
        }
        QueryTest::TearDown();
    }

    ShapeHandle add_shape(const Rings& rings) {
        const Expected<ShapeHandle> shape = context().add_shape(rings);
        EXPECT_TRUE(shape.has_value()) << shape.error().message();
        shapes_.push_back(*shape);
        return *shape;
    }
    InstanceHandle add(ShapeHandle shape, const Pose& pose) {
        const Expected<InstanceHandle> handle = world_->add({.shape = shape, .pose = pose});
        EXPECT_TRUE(handle.has_value()) << handle.error().message();
        return *handle;
    }
    [[nodiscard]] static Pose any_pose(Random& random, double extent) {
        return {.translation = {random.between(-extent, extent), random.between(-extent, extent)},
                .angle = random.between(-4.0, 4.0)};
    }
    /// Removes instances that were added.
    void remove(const std::vector<InstanceHandle>& instances) {
        for (const InstanceHandle handle : instances) {
            ASSERT_TRUE(world().remove(handle).ok());
        }
    }

    World& world() { return *world_; }

    /// Any sequence of changes: adds, moves, filters and removes instances of some_shapes(), which
    /// deform, and calls `compare` after each step.
    template <class Compare>
    void run_history(Random& random, const History& history, const Compare& compare) {
        std::vector<ShapeHandle> shapes;
        for (const Rings& rings : some_shapes(random)) {
            shapes.push_back(add_shape(rings));
        }
        const auto any_of_shapes = [&] {
            return shapes[static_cast<std::size_t>(
                random.whole(0, static_cast<int>(shapes.size()) - 1))];
        };
        std::vector<InstanceHandle> present;
        for (int step = 0; step < history.steps; ++step) {
            SCOPED_TRACE("step " + std::to_string(step));
            for (int i = step == 0 ? history.instances : random.whole(0, 20); i > 0; --i) {
                present.push_back(add(any_of_shapes(), any_pose(random, history.extent)));
            }
            ASSERT_NO_FATAL_FAILURE(change_some(random, present, history.extent));
            for (int i = random.whole(0, 10); i > 0; --i) {
                ASSERT_TRUE(world().remove(present.back()).ok());
                present.pop_back();
            }
            if (random.whole(0, 2) == 0) {
                const Rings rings =
                    random.whole(0, 1) == 0 ? star(random, 40, 0.4) : with_holes(random, 4);
                ASSERT_TRUE(context().update_shape(any_of_shapes(), rings).ok());
            }
            ASSERT_NO_FATAL_FAILURE(compare());
        }
        remove(present);
    }

private:
    /// Gives about a quarter of the instances another pose, and some another filter.
    void change_some(Random& random, const std::vector<InstanceHandle>& instances, double extent) {
        for (const InstanceHandle handle : instances) {
            if (random.whole(0, 3) == 0) {
                ASSERT_TRUE(world().move(handle, any_pose(random, extent)).ok());
            }
            if (random.whole(0, 30) == 0) {
                const auto bits = static_cast<std::uint32_t>(random.whole(1, 3));
                ASSERT_TRUE(world().set_filter(handle, bits, 3 - bits / 2).ok());
            }
        }
    }

    std::optional<World> world_;
    std::vector<ShapeHandle> shapes_;
};

/// The same with the host's side of the device.
class DevicePairsOfHostTest : public DevicePairsTest {
protected:
    void SetUp() override {
        DevicePairsTest::SetUp();
        gpu_.emplace(host_device());
    }
    void TearDown() override {
        DevicePairsTest::TearDown();
        gpu_.reset();
    }

    test_support::HostGpu& gpu() { return *gpu_; }

private:
    std::optional<test_support::HostGpu> gpu_;
};

}  // namespace nearfield::test
