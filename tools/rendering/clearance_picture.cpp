#include <tools/io/summary.hpp>
#include <tools/io/world_report.hpp>
#include <tools/rendering/clearance_picture.hpp>
#include <tools/rendering/scene_picture.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace nearfield::tools {
namespace {

using simulation::ClearanceFrame;
using simulation::ClearanceScene;

constexpr double band_height = 66.0;
constexpr double bar_height = 14.0;
constexpr double small = 12.5;
constexpr double large = 17.0;

/// The bar of colours: to the left of `zero` depths, to the right of it clearances.
struct Bar {
    double left = 0.0;
    double zero = 0.0;
    double right = 0.0;
    double top = 0.0;
    bool has_depths = true;  ///< otherwise all overlaps have the colour of contact

    [[nodiscard]] double x_at(double position) const {
        return position < 0.0 ? zero + position * (zero - left) : zero + position * (right - zero);
    }
};

void draw_bar(Drawing& drawing, const Bar& bar) {
    ColoredCells cells;
    cells.rectangle = {{bar.left, bar.top}, {bar.right, bar.top + bar_height}};
    cells.columns = static_cast<std::size_t>(bar.right - bar.left);
    cells.rows = 1;
    for (std::size_t column = 0; column < cells.columns; ++column) {
        const double x = bar.left + static_cast<double>(column) + 0.5;
        const double side = x < bar.zero ? bar.zero - bar.left : bar.right - bar.zero;
        cells.colors.push_back(
            clearance_color(x < bar.zero && !bar.has_depths ? 0.0 : (x - bar.zero) / side));
    }
    drawing.cells(std::move(cells));
}

void draw_mark(Drawing& drawing, Vector2 tip) {
    drawing.fill({{tip, {tip.x - 6.0, tip.y - 9.0}, {tip.x + 6.0, tip.y - 9.0}}}, palette::text);
}

/// 80000 as "80,000".
std::string count_text(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t place = text.size(); place > 3; place -= 3) {
        text.insert(place - 3, ",");
    }
    return text;
}

std::string in_thousandths(double number) {
    return short_number(std::round(1000.0 * number) / 1000.0);
}

std::string finding(const ClearanceScene& scene) {
    const Clearance& clearance = scene.frame().clearance;
    const std::string subject = scene.frame().paths > 1 ? "best path: " : "";
    if (clearance.distance > 0.0) {
        const bool beyond = clearance.distance == scene.query().max_clearance;
        return subject + "clearance " + (beyond ? "at least " : "") +
               in_thousandths(clearance.distance);
    }
    return subject + "overlap" +
           (clearance.distance < 0.0 ? ", depth " + in_thousandths(-clearance.distance) : "");
}

std::string question(const ClearanceFrame& frame) {
    if (frame.paths == 1) {
        return "coloured by its clearance from all others and the strip's edge";
    }
    return count_text(frame.free_paths) + " of " + count_text(frame.paths) + " paths are free, " +
           count_text(frame.poses) + " poses in one call";
}

/// Adds the scale of the colours with a mark at the last frame's clearance, and what this frame
/// asked and found, at the lower edge of the page.
void draw_clearance_legend(Drawing& drawing, const ClearanceScene& scene, const Rectangle& page) {
    const ClearanceQuery query = scene.query();
    Bar bar;
    bar.has_depths = query.min_clearance < 0.0;
    bar.left = page.min.x + 26.0;
    bar.zero = bar.left + (bar.has_depths ? 170.0 : 76.0);
    bar.right = bar.zero + 170.0;
    bar.top = page.max.y - 46.0;
    drawing.cells({{{page.min.x, page.max.y - band_height}, page.max}, 1, 1, {palette::page}});
    drawing.line({{page.min.x, page.max.y - band_height}, {page.max.x, page.max.y - band_height}},
                 palette::frame, 1.0);
    draw_bar(drawing, bar);
    draw_mark(
        drawing,
        {bar.x_at(std::clamp(scene.frame().clearance.distance / query.max_clearance, -1.0, 1.0)),
         bar.top - 1.0});
    const double ticks = bar.top + bar_height + 16.0;
    const std::string most = short_number(query.max_clearance);
    drawing.text({bar.right, ticks}, most, small, palette::quiet_text, Align::center);
    drawing.text({bar.zero, ticks}, "0", small, palette::quiet_text, Align::center);
    drawing.text({0.5 * (bar.zero + bar.right), ticks}, "clearance", small, palette::quiet_text,
                 Align::center);
    if (bar.has_depths) {
        drawing.text({bar.left, ticks}, most, small, palette::quiet_text, Align::center);
    }
    drawing.text({0.5 * (bar.left + bar.zero), ticks}, bar.has_depths ? "depth" : "overlap", small,
                 palette::quiet_text, Align::center);
    const double text = bar.right + 36.0;
    drawing.text({text, bar.top + 9.0}, finding(scene), large, palette::text);
    drawing.text({text, ticks}, question(scene.frame()), small, palette::quiet_text);
}

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
