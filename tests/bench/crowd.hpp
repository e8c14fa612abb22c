#pragma once

#include <nearfield/context.hpp>
#include <nearfield/world.hpp>

#include <tests/bench/take.hpp>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::bench {

/// A world of stars of 50 vertices and radius 1, scattered over a square.
class Crowd {
public:
    Crowd(Context& context, std::uint32_t count, double side)
        : random_(count), side_(side), world_(take(World::create(context))) {
        std::vector<ShapeHandle> shapes;
        shapes.reserve(20);
        for (int i = 0; i < 20; ++i) {
            shapes.push_back(take(context.add_shape(test::star(random_, 50, 0.5))));
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const Pose pose{place(), random_.between(0.0, 6.0)};
            handles_.push_back(take(world_.add({.shape = shapes[i % 20], .pose = pose})));
            poses_.push_back(pose);
        }
    }

    [[nodiscard]] World& world() { return world_; }
    [[nodiscard]] test::Random& random() { return random_; }
    /// Anywhere in the square.
    [[nodiscard]] Vector2 place() {
        return {random_.between(0.0, side_), random_.between(0.0, side_)};
    }
    /// Moves all of them a little.
    void move() {
        for (Pose& pose : poses_) {
            pose.translation.x += 1e-3;
            pose.angle += 1e-3;
        }
        require(world_.move(handles_, poses_));
    }

private:
    test::Random random_;
    double side_;
    World world_;
    std::vector<InstanceHandle> handles_;
    std::vector<Pose> poses_;
};

}  // namespace nearfield::bench
