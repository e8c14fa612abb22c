#pragma once

#include <tools/simulation/clearance_scene.hpp>

#include <cstddef>

namespace nearfield::simulation {

/// A robot on its way between islands. In each frame it takes 2,000 paths into consideration, 40
/// poses each, and follows the one that ends nearest to the goal and keeps clear of the islands.
/// The user can drag the robot and the goal.
class Robots final : public ClearanceScene {
public:
    explicit Robots(Context& context);

    void grab(Vector2 point) override;
    void drag(Vector2 point) override;
    void release() override { held_ = Held::nothing; }
    [[nodiscard]] const std::vector<Ring>& mover() const override { return footprint_; }

protected:
    void move() override;
    void list_poses(std::vector<Pose>& poses) const override;
    [[nodiscard]] std::size_t best_path() const override;

private:
    enum class Held { nothing, robot, goal };

    /// What a path would cost: how far from the goal it leaves the robot, and how near to an island
    /// it takes it.
    [[nodiscard]] double cost(std::size_t path) const;

    std::vector<Ring> footprint_;
    std::size_t next_goal_ = 0;
    Held held_ = Held::nothing;
    Vector2 offset_;  // from the position of what is held to the mouse
};

}  // namespace nearfield::simulation
