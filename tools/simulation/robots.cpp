#include <tools/simulation/plane.hpp>
#include <tools/simulation/robots.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nearfield::simulation {
namespace {

constexpr Vector2 map_size{24.0, 13.0};
/// Paths differ in the curvature at their start and at their end.
constexpr std::size_t starts = 50;
constexpr std::size_t ends = 40;
constexpr std::size_t poses_a_path = 40;
constexpr double path_length = 7.0;
constexpr double max_curvature = 1.3;
constexpr double speed = 1.5;          // a second
constexpr double turning_speed = 1.0;  // radians a second, where all paths are blocked
constexpr double comfort = 0.4;        // a smaller clearance has its cost
constexpr double price_of_discomfort = 8.0;
constexpr double goal_radius = 0.5;

constexpr std::array<Vector2, 6> goals{
    {{22.5, 11.5}, {1.5, 11.0}, {12.0, 6.5}, {22.5, 1.2}, {6.5, 6.0}, {1.5, 1.5}}};

/// Where islands lie: the number of the country, and its pose.
struct Island {
    std::size_t country;
    Pose pose;
};
constexpr std::array<Island, 12> islands{{{0, {{4.0, 3.6}, 0.0}},
                                          {1, {{9.0, 2.6}, 0.4}},
                                          {2, {{14.4, 2.6}, 0.2}},
                                          {4, {{19.6, 3.4}, 0.6}},
                                          {3, {{3.2, 8.4}, 1.2}},
                                          {5, {{9.6, 6.6}, 0.5}},
                                          {1, {{15.4, 6.8}, 2.0}},
                                          {0, {{20.4, 7.6}, 2.6}},
                                          {4, {{6.6, 10.8}, 1.4}},
                                          {2, {{12.0, 10.4}, 3.0}},
                                          {3, {{17.4, 10.6}, 0.9}},
                                          {5, {{22.0, 4.0}, 1.5}}}};

/// A vehicle of 12 vertices with a blunt bow.
Ring vehicle() {
    return {{0.42, 0.0}, {0.36, 0.12},   {0.22, 0.2},  {-0.1, 0.22},  {-0.3, 0.2},  {-0.38, 0.14},
            {-0.4, 0.0}, {-0.38, -0.14}, {-0.3, -0.2}, {-0.1, -0.22}, {0.22, -0.2}, {0.36, -0.12}};
}

double fraction(std::size_t part, std::size_t count) {
    return static_cast<double>(part) / static_cast<double>(count - 1);
}

/// The pose at the end of an arc of this length and curvature.
Pose along_arc(const Pose& from, double curvature, double length) {
    const double half_turn = 0.5 * curvature * length;
    const double chord =
        half_turn == 0.0 ? length : length * sine_cosine(half_turn).sine / half_turn;
    return {from.translation + polar(chord, from.angle + half_turn), from.angle + 2.0 * half_turn};
}

/// A path's curvature at a fraction of its length: from -max_curvature to max_curvature.
double curvature(std::size_t path, double part) {
    const double start = fraction(path / ends, starts);
    const double end = fraction(path % ends, ends);
    return max_curvature * (2.0 * std::lerp(start, end, part) - 1.0);
}

}  // namespace

Robots::Robots(Context& context)
    : ClearanceScene(context, {.name = "robots",
                               .view = {{0.0, -1.7}, map_size},
                               .poses_a_path = poses_a_path,
                               .min_clearance = 0.0,
                               .max_clearance = 0.6}),
      footprint_{vehicle()} {
    const std::vector<Ring> outlines = countries(3.6);
    for (const Island& island : islands) {
        add_obstacle({outlines[island.country]}, island.pose);
    }
    shape_ = add_shape(footprint_);
    pose_ = {{1.2, 1.2}, 0.6};
    goal_ = goals[next_goal_];
}

void Robots::list_poses(std::vector<Pose>& poses) const {
    for (std::size_t path = 0; path < starts * ends; ++path) {
        Pose pose = pose_;
        for (std::size_t i = 0; i < poses_a_path; ++i) {
            poses.push_back(pose);
            pose = along_arc(pose, curvature(path, fraction(i, poses_a_path)),
                             path_length / static_cast<double>(poses_a_path - 1));
        }
    }
}

double Robots::cost(std::size_t path) const {
    const double clear = clearance(path).distance;
    if (clear <= 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Pose& pose : this->path(path)) {
        nearest = std::min(nearest, length(*goal_ - pose.translation));
    }
    return nearest + price_of_discomfort * std::max(0.0, comfort - clear);
}

std::size_t Robots::best_path() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t path = 0; path < starts * ends; ++path) {
        const double cost = this->cost(path);
        if (cost < least) {
            least = cost;
            best = path;
        }
    }
    return best;
}

void Robots::move() {
    if (length(*goal_ - pose_.translation) < goal_radius && held_ != Held::goal) {
        next_goal_ = (next_goal_ + 1) % goals.size();
        goal_ = goals[next_goal_];
    }
    if (held_ == Held::robot) {
        return;
    }
    if (frame().free_paths == 0) {
        pose_.angle += turning_speed * frame_time;
    } else {
        pose_ = along_arc(pose_, curvature(frame().best_path, 0.0), speed * frame_time);
    }
}

void Robots::grab(Vector2 point) {
    release();
    constexpr double reach = 0.6;
    if (length(point - pose_.translation) <= reach) {
        held_ = Held::robot;
        offset_ = point - pose_.translation;
    } else if (length(point - *goal_) <= reach) {
        held_ = Held::goal;
        offset_ = point - *goal_;
    }
}

void Robots::drag(Vector2 point) {
    if (held_ == Held::robot) {
        pose_.translation = point - offset_;
    } else if (held_ == Held::goal) {
        goal_ = point - offset_;
    }
}

}  // namespace nearfield::simulation
