#pragma once

#include <nearfield/shape.hpp>

#include <tools/simulation/clearance_scene.hpp>

#include <vector>

namespace nearfield::simulation {

/// An item to be cut from a strip: its outer boundary, then its holes, about the origin.
using NestItem = std::vector<Ring>;

/// Items nested in a strip, one of which is dragged over the others. The strip's edge counts as an
/// obstacle, the first one. Until the user takes an item, one of them follows a path of its own.
class Nest final : public ClearanceScene {
public:
    /// Nests the items: each at the first place, from the left, where it keeps a gap.
    explicit Nest(Context& context);

    void grab(Vector2 point) override;
    void drag(Vector2 point) override;
    void release() override { held_.reset(); }
    [[nodiscard]] const std::vector<Ring>& mover() const override {
        return obstacles_[*moving_obstacle_].rings;
    }

protected:
    void move() override;
    void list_poses(std::vector<Pose>& poses) const override { poses.push_back(pose_); }
    [[nodiscard]] std::size_t best_path() const override { return 0; }

private:
    void nest(std::vector<Ring> item);
    /// Makes an item the one that moves.
    void take(std::size_t item);
    /// Moves it.
    void place(const Pose& pose);

    bool taken_by_user_ = false;
    std::optional<Vector2> held_;  // from the item's position to the mouse
};

}  // namespace nearfield::simulation
