#include <tools/common/library_error.hpp>
#include <tools/simulation/nest.hpp>
#include <tools/simulation/nest_items.hpp>
#include <tools/simulation/plane.hpp>

#include <numbers>
#include <stdexcept>
#include <utility>

namespace nearfield::simulation {
namespace {

constexpr double strip_length = 21.0;
constexpr double strip_width = 8.6;
constexpr double edge_width = 0.3;
/// The item that follows a path until the user takes one.
constexpr std::size_t wanderer = 16;

Ring box(Vector2 min, Vector2 max) {
    return {min, {max.x, min.y}, max, {min.x, max.y}};
}

/// The strip's edge.
std::vector<Ring> edge() {
    return {box({-edge_width, -edge_width}, {strip_length + edge_width, strip_width + edge_width}),
            box({}, {strip_length, strip_width})};
}

/// Back and forth between the free end of the strip and the items.
Pose on_its_way(double time) {
    return {
        {11.0 + 7.8 * sine_cosine(0.35 * time).cosine, 4.3 + 2.9 * sine_cosine(0.91 * time).sine},
        0.4 * time};
}

}  // namespace

Nest::Nest(Context& context)
    : ClearanceScene(context, {.name = "nest",
                               .view = {{-0.7, -2.2}, {strip_length + 0.7, strip_width + 0.7}}}) {
    add_obstacle(edge(), {});
    for (NestItem& item : nest_items()) {
        nest(std::move(item));
    }
    take(wanderer);
    place(on_its_way(0.0));
}

void Nest::nest(std::vector<Ring> item) {
    constexpr double gap = 0.1;
    constexpr double step = 0.15;
    ClearanceQuery query{.shape = add_shape(item)};
    query.min_clearance = 0.0;
    query.max_clearance = gap;
    std::vector<Pose> poses;
    std::vector<Clearance> clearances;
    const auto columns = static_cast<int>(strip_length / step);
    const auto rows = static_cast<int>(strip_width / step);
    for (int column = 0; column <= columns; ++column) {
        poses.clear();
        for (int row = 0; row <= rows; ++row) {
            for (int quarter = 0; quarter < 4; ++quarter) {
                poses.push_back({{step * column, step * row}, 0.5 * std::numbers::pi * quarter});
            }
        }
        clearances.resize(poses.size());
        tools::require(world().find_clearances(query, poses, clearances));
        for (std::size_t i = 0; i < poses.size(); ++i) {
            if (clearances[i].distance >= gap) {
                add_obstacle(std::move(item), poses[i]);
                return;
            }
        }
    }
    throw std::logic_error("an item does not fit into the strip");
}

void Nest::take(std::size_t item) {
    moving_obstacle_ = item;
    shape_ = obstacles_[item].shape;
    pose_ = obstacles_[item].pose;
}

void Nest::place(const Pose& pose) {
    Obstacle& item = obstacles_[*moving_obstacle_];
    tools::require(world().move(item.instance, pose));
    pose_ = item.pose = pose;
}

void Nest::move() {
    if (!taken_by_user_) {
        place(on_its_way(frame().time));
    }
}

void Nest::grab(Vector2 point) {
    release();
    const std::optional<std::size_t> item = obstacle_at(point);
    if (item.value_or(0) == 0) {
        return;  // nothing, or the strip's edge
    }
    taken_by_user_ = true;
    take(*item);
    held_ = point - pose_.translation;
}

void Nest::drag(Vector2 point) {
    if (held_) {
        place({point - *held_, pose_.angle});
    }
}

}  // namespace nearfield::simulation
