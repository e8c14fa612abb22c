#pragma once

#include <nearfield/context.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/world.hpp>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::simulation {

/// A shape that a scene of clearances keeps in its world.
struct Obstacle {
    std::vector<Ring> rings;
    Pose pose;
    ShapeHandle shape;
    InstanceHandle instance;
};

/// What a frame asked and found.
struct ClearanceFrame {
    double time = 0.0;                    ///< of the scene, seconds
    Pose pose;                            ///< of the shape that moves
    double milliseconds = 0.0;            ///< spent in the frame's one call of the library
    std::size_t poses = 0;                ///< asked about in that call
    std::size_t paths = 0;                ///< that these poses make up
    std::size_t free_paths = 0;           ///< those with a clearance above 0
    std::size_t best_path = 0;            ///< the one to take
    Clearance clearance;                  ///< the least along that path
    std::optional<std::size_t> neighbor;  ///< the obstacle that `clearance` is from
};

/// A shape that moves among obstacles, and the clearances of the paths that it could take:
/// sequences of poses, for all of which a frame asks a world in one call. Nothing is pushed, unlike
/// in a Scene. All members throw tools::LibraryError if the library rejects something.
class ClearanceScene {
public:
    virtual ~ClearanceScene();
    ClearanceScene(const ClearanceScene&) = delete;
    ClearanceScene& operator=(const ClearanceScene&) = delete;

    /// Moves by a frame whatever the user has not taken, and asks.
    void advance();
    /// Asks for the clearances of all paths from the present pose.
    void ask();

    /// Takes what can be dragged at a point, if there is something.
    virtual void grab(Vector2 point) = 0;
    /// Moves what was taken along with the point.
    virtual void drag(Vector2 point) = 0;
    virtual void release() = 0;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const Rectangle& view() const { return view_; }  ///< the part shown in a picture
    /// The number of edges of all outlines.
    [[nodiscard]] std::size_t line_count() const;
    [[nodiscard]] const std::vector<Obstacle>& obstacles() const { return obstacles_; }
    /// The shape that moves, in its own coordinates.
    [[nodiscard]] virtual const std::vector<Ring>& mover() const = 0;
    [[nodiscard]] const Pose& pose() const { return pose_; }
    /// The mover, if it is one of the obstacles; queries leave it out.
    [[nodiscard]] std::optional<std::size_t> moving_obstacle() const { return moving_obstacle_; }
    /// The place that the mover is on its way to.
    [[nodiscard]] std::optional<Vector2> goal() const { return goal_; }

    /// What the last frame asked: this query at these poses, path by path; and what it found.
    [[nodiscard]] ClearanceQuery query() const;
    /// The instances that it considers: all but the one that moves.
    [[nodiscard]] WorldFilter filter() const;
    [[nodiscard]] std::span<const Pose> poses() const { return poses_; }
    [[nodiscard]] std::span<const Clearance> clearances() const { return clearances_; }
    [[nodiscard]] const ClearanceFrame& frame() const { return frame_; }
    [[nodiscard]] std::span<const Pose> path(std::size_t path) const;
    /// The least clearance of a path.
    [[nodiscard]] const Clearance& clearance(std::size_t path) const {
        return clearances_[least_[path]];
    }
    [[nodiscard]] nearfield::World& world() { return world_; }

    static constexpr double frame_time = 1.0 / 60.0;

protected:
    /// The parts that scenes differ in.
    struct Setting {
        std::string name;
        Rectangle view;
        std::size_t poses_a_path = 1;
        double min_clearance = -std::numeric_limits<double>::infinity();  ///< of the queries
        double max_clearance = 1.0;                                       ///< likewise
    };

    ClearanceScene(Context& context, const Setting& setting);

    ShapeHandle add_shape(const std::vector<Ring>& rings);
    void add_obstacle(std::vector<Ring> rings, const Pose& pose);
    /// The obstacle that a point lies in; of several, the last one.
    [[nodiscard]] std::optional<std::size_t> obstacle_at(Vector2 point);

    /// Moves the mover to where it is at frame().time.
    virtual void move() = 0;
    /// Adds the poses of all paths from the present pose.
    virtual void list_poses(std::vector<Pose>& poses) const = 0;
    /// Chooses a path by its clearance.
    [[nodiscard]] virtual std::size_t best_path() const = 0;

    Pose pose_;
    ShapeHandle shape_;  // of the mover
    std::optional<std::size_t> moving_obstacle_;
    std::optional<Vector2> goal_;
    std::vector<Obstacle> obstacles_;

private:
    Context& context_;
    nearfield::World world_;
    std::string name_;
    Rectangle view_;
    std::size_t poses_a_path_;
    double min_clearance_;
    double max_clearance_;
    std::vector<ShapeHandle> shapes_;  // all that were added to the context
    std::vector<Pose> poses_;
    std::vector<Clearance> clearances_;
    std::vector<std::size_t> least_;  // of each path, the pose with the least clearance
    std::size_t frames_ = 0;
    ClearanceFrame frame_;
};

/// A scene of clearances with its name.
struct NamedClearanceScene {
    const char* name;
    std::unique_ptr<ClearanceScene> (*make)(Context& context);
};

/// All of them: items in a strip, one of which is dragged over the others, and a robot
/// that finds its way between islands. Each is identical every time it is made, and
/// has asked for its first frame. The context must outlive it.
[[nodiscard]] std::span<const NamedClearanceScene> clearance_scenes();

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
