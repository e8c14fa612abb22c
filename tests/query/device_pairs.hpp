#pragma once

#include <tests/query/query_test.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace nearfield::test {

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

private:
    std::optional<World> world_;
    std::vector<ShapeHandle> shapes_;
};

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

}  // namespace nearfield::test
