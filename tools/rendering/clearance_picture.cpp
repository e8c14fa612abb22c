#include <tools/io/world_records.hpp>
#include <tools/rendering/clearance_legend.hpp>
#include <tools/rendering/clearance_picture.hpp>
#include <tools/rendering/scene_picture.hpp>

#include <algorithm>
#include <numeric>

namespace nearfield::tools {
namespace {

using simulation::ClearanceScene;

constexpr Color obstacle_color = rgb(0xD7DCE3);
constexpr Color obstacle_line = rgb(0x8893A2);
constexpr Color neighbor_line = palette::text;

void draw_shape(Drawing& drawing, std::vector<Ring> rings, const Color& fill, const Color& line,
                double width) {
    for (const Ring& ring : rings) {
        drawing.line(ring, line, width, true);
    }
    drawing.fill(std::move(rings), fill);
}

void draw_obstacles(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    for (std::size_t i = 0; i < scene.obstacles().size(); ++i) {
        if (scene.moving_obstacle() == i) {
            continue;
        }
        const simulation::Obstacle& obstacle = scene.obstacles()[i];
        const bool nearest = scene.frame().neighbor == i;
        draw_shape(drawing, on_page(obstacle.rings, obstacle.pose, view), obstacle_color,
                   nearest ? neighbor_line : obstacle_line, nearest ? 2.4 : 1.6);
    }
}

/// A path on the page. Every second pose is enough for a smooth line.
std::vector<Vector2> line_of(std::span<const Pose> path, const View& view) {
    std::vector<Vector2> line;
    for (std::size_t i = 0; i < path.size(); i += 2) {
        line.push_back(view.to_page(path[i].translation));
    }
    return line;
}

/// The clearest paths come last, and cover the others.
void draw_paths(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    std::vector<std::size_t> order(scene.frame().paths);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&scene](std::size_t a, std::size_t b) {
        return scene.clearance(a).distance < scene.clearance(b).distance;
    });
    for (const std::size_t path : order) {
        const double clearance = scene.clearance(path).distance;
        const Color color = clearance_color(clearance / scene.query().max_clearance);
        drawing.line(line_of(scene.path(path), view),
                     clearance > 0.0 ? color : color.with_alpha(0.12), 1.0);
    }
}

/// The best path, with the shape where it is least clear.
void draw_best_path(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    const std::span<const Pose> path = scene.path(scene.frame().best_path);
    const std::vector<Vector2> line = line_of(path, view);
    drawing.line(line, palette::page, 6.0);
    drawing.line(line, palette::text, 2.6);
    constexpr std::size_t pause = 6;
    for (std::size_t i = pause; i < path.size(); i += pause) {
        for (Ring& ring : on_page(scene.mover(), path[i], view)) {
            drawing.line(std::move(ring), palette::text, 1.2, true);
        }
    }
}

void draw_goal(Drawing& drawing, Vector2 goal) {
    drawing.dot(goal, 13.0, palette::text);
    drawing.dot(goal, 10.0, palette::page);
    drawing.dot(goal, 5.5, palette::shape_a);
}

/// The nearest points with a line between them, or at a vertex that is inside, the way out.
void draw_nearest(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    const Clearance& clearance = scene.frame().clearance;
    if (!is_direction(clearance.direction)) {
        return;
    }
    const Vector2 from = view.to_page(clearance.point);
    const Vector2 to = view.to_page(clearance.nearest);
    drawing.line({from, to}, palette::page, 5.0);
    drawing.line({from, to}, palette::text, 2.0);
    for (const Vector2& end : {from, to}) {
        drawing.dot(end, 5.0, palette::page);
        drawing.dot(end, 3.6, palette::text);
    }
}

}  // namespace

void draw_clearances(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    draw_obstacles(drawing, scene, view);
    const bool along_paths = scene.path(0).size() > 1;
    if (along_paths) {
        draw_paths(drawing, scene, view);
        draw_best_path(drawing, scene, view);
    }
    if (scene.goal()) {
        draw_goal(drawing, view.to_page(*scene.goal()));
    }
    const double clearance = scene.frame().clearance.distance;
    draw_shape(drawing, on_page(scene.mover(), scene.pose(), view),
               clearance_color(clearance / scene.query().max_clearance).with_alpha(0.9),
               palette::text, 2.4);
    draw_nearest(drawing, scene, view);
    draw_clearance_legend(drawing, scene, view.page());
}

}  // namespace nearfield::tools
