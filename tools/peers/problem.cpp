#include <tools/benchmark/workloads.hpp>
#include <tools/peers/problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nearfield::peers {
namespace {

Rectangle box_of(const std::vector<Ring>& rings) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Rectangle box{{infinity, infinity}, {-infinity, -infinity}};
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            box.min = {std::min(box.min.x, vertex.x), std::min(box.min.y, vertex.y)};
            box.max = {std::max(box.max.x, vertex.x), std::max(box.max.y, vertex.y)};
        }
    }
    return box;
}

bool holds(const Rectangle& box, const Vector2& point) {
    return point.x >= box.min.x && point.x <= box.max.x && point.y >= box.min.y &&
           point.y <= box.max.y;
}

bool passes_by(const Rectangle& box, const Vector2& from, const Vector2& to) {
    return std::max(from.x, to.x) < box.min.x || std::min(from.x, to.x) > box.max.x ||
           std::max(from.y, to.y) < box.min.y || std::min(from.y, to.y) > box.max.y;
}

void samples_in(const Vector2& from, const Vector2& to, double spacing, const Rectangle& box,
                std::vector<Vector2>& points) {
    if (passes_by(box, from, to)) {
        return;
    }
    const auto pieces =
        static_cast<std::size_t>(std::ceil(std::hypot(to.x - from.x, to.y - from.y) / spacing));
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const double t = static_cast<double>(piece) / static_cast<double>(pieces);
        const Vector2 point{std::lerp(from.x, to.x, t), std::lerp(from.y, to.y, t)};
        if (holds(box, point)) {
            points.push_back(point);
        }
    }
}

}  // namespace

Grid grid_of(const tools::QueryRequest& request) {
    const double cell = request.tolerance * std::numbers::sqrt2;
    const Rectangle& area = *request.rectangle;
    return {area.min, cell, static_cast<std::size_t>(std::lround((area.max.x - area.min.x) / cell)),
            static_cast<std::size_t>(std::lround((area.max.y - area.min.y) / cell))};
}

void place(const tools::Scene& scene, std::vector<PlacedShape>& placed) {
    placed.resize(scene.instances.size());
    for (std::size_t index = 0; index < placed.size(); ++index) {
        const tools::SceneInstance& instance = scene.instances[index];
        PlacedShape& shape = placed[index];
        shape.rings = scene.shapes[instance.shape].rings;
        for (Ring& ring : shape.rings) {
            std::transform(ring.begin(), ring.end(), ring.begin(), Placement(instance.pose));
        }
        shape.box = box_of(shape.rings);
    }
}

void points_in(const PlacedShape& a, double spacing, const Rectangle& box,
               std::vector<Vector2>& points) {
    points.clear();
    for (const Ring& ring : a.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (spacing > 0.0) {
                samples_in(ring[i], ring[(i + 1) % ring.size()], spacing, box, points);
            } else if (holds(box, ring[i])) {
                points.push_back(ring[i]);
            }
        }
    }
}

namespace {

struct NamedScene {
    std::string name;
    tools::Scene scene;
    double tolerance = 0.0;
};

struct PairTask {
    Task task;
    tools::QueryRequest (*request)(double tolerance);
    double reach_in_tolerances;  ///< the reach of boxes within which a pair is queried
};

constexpr PairTask pair_tasks[] = {
    {Task::vertex_penetration, benchmark::vertex_penetration, 0.0},
    {Task::boundary_penetration, benchmark::boundary_penetration, 0.0},
    {Task::separation, benchmark::separation, 20.0},
    {Task::intersection_test, benchmark::intersection_test, 0.0},
    {Task::common_area, benchmark::intersection, 0.0},
};

bool near_each_other(const Rectangle& a, const Rectangle& b, double reach) {
    return a.min.x - reach <= b.max.x && b.min.x - reach <= a.max.x && a.min.y - reach <= b.max.y &&
           b.min.y - reach <= a.max.y;
}

/// Lists every pair whose boxes are within reach once. All libraries get the same list, so no broad
/// phase is measured.
tools::Scene asked_of_pairs(tools::Scene scene, const tools::QueryRequest& request, double reach) {
    std::vector<PlacedShape> placed;
    place(scene, placed);
    for (std::size_t a = 0; a < placed.size(); ++a) {
        for (std::size_t b = a + 1; b < placed.size(); ++b) {
            if (near_each_other(placed[a].box, placed[b].box, reach)) {
                scene.queries.push_back({request, a, b});
            }
        }
    }
    return scene;
}

/// The two coast lines are one pair, whatever their distance.
tools::Scene asked_of(const NamedScene& named, const PairTask& task) {
    const tools::QueryRequest request = task.request(named.tolerance);
    return named.scene.instances.size() == 2
               ? benchmark::asked(named.scene, request, 0, 1)
               : asked_of_pairs(named.scene, request, task.reach_in_tolerances * named.tolerance);
}

/// A field around every object.
Problem field_of_each(std::string name, tools::Scene scene, double side, std::size_t cells) {
    for (std::size_t b = 0; b < scene.instances.size(); ++b) {
        scene.queries.push_back(
            {benchmark::square_field(scene.instances[b].pose.translation, side, cells), b, b});
    }
    return {std::move(name), Task::field, std::move(scene)};
}

tools::Scene iceland_alone() {
    tools::Scene scene;
    benchmark::add_object(scene, benchmark::iceland(), {});
    return scene;
}

using benchmark::Random;

constexpr double whole_turn = 2.0 * std::numbers::pi;

Pose anywhere(Random& random, const Vector2& low, const Vector2& high) {
    return {{random.between(low.x, high.x), random.between(low.y, high.y)},
            random.between(0.0, whole_turn)};
}

/// Asks all instances; `item` is the shape at the poses, if there are any.
Problem world_problem(std::string name, Task task, tools::Scene scene, tools::WorldRequest request,
                      Ring item = {}) {
    if (!item.empty()) {
        request.shape = scene.shapes.size();
        scene.shapes.push_back({"item", {std::move(item)}});
    }
    scene.queries.emplace_back().world = std::move(request);
    return {std::move(name), task, std::move(scene)};
}

/// 48 items of 21 vertices side by side, and another one at many poses among and beside them.
Problem layout() {
    tools::Scene scene;
    Random random(41);
    for (std::size_t i = 0; i < 48; ++i) {
        Ring item = benchmark::star(random, 21);  // fixes the evaluation order: before the angle
        benchmark::add_object(
            scene, {std::move(item)},
            {benchmark::in_rows(i, 8, {2.1, 2.1}), random.between(0.0, whole_turn)});
    }
    Ring item = benchmark::star(random, 21);
    tools::WorldRequest request;
    for (int i = 0; i < 1'000'000; ++i) {
        request.poses.push_back(anywhere(random, {-4.0, -4.0}, {32.0, 20.0}));
    }
    return world_problem("48 items, 1,008 vertices: an item at 1,000,000 poses, hit or not",
                         Task::pose_hits, std::move(scene), std::move(request), std::move(item));
}

/// Paths of a footprint over coast lines: both islands twice, 10,612 edges in all.
Problem paths() {
    tools::Scene scene;
    benchmark::add_object(scene, benchmark::iceland(), {{0.0, 0.0}, 0.0});
    benchmark::add_object(scene, benchmark::ireland(), {{600.0, 0.0}, 0.0});
    benchmark::add_object(scene, benchmark::iceland(), {{0.0, 600.0}, 2.0});
    benchmark::add_object(scene, benchmark::ireland(), {{600.0, 600.0}, 4.0});
    Ring footprint;
    for (int i = 0; i < 12; ++i) {
        const double angle = whole_turn * i / 12.0;
        footprint.push_back({4.0 * std::cos(angle), 2.0 * std::sin(angle)});
    }
    tools::WorldRequest request;
    request.clearance = true;
    Random random(43);
    for (int path = 0; path < 2000; ++path) {
        Pose pose = anywhere(random, {-400.0, -400.0}, {1000.0, 1000.0});
        const double bend = random.between(-0.1, 0.1);
        for (int i = 0; i < 56; ++i) {
            request.poses.push_back(pose);
            pose.translation.x += 2.0 * std::cos(pose.angle);
            pose.translation.y += 2.0 * std::sin(pose.angle);
            pose.angle += bend;
        }
    }
    return world_problem("112,000 footprints of 12 vertices, 10,612 edges: least distances",
                         Task::pose_distances, std::move(scene), std::move(request),
                         std::move(footprint));
}

Problem many_polygons() {
    tools::Scene scene;
    Random random(47);
    for (int i = 0; i < 100'000; ++i) {
        Ring polygon = benchmark::star(random, 50);
        benchmark::add_object(scene, {std::move(polygon)},
                              anywhere(random, {0.0, 0.0}, {1000.0, 1000.0}));
    }
    tools::WorldRequest request;
    request.type = tools::WorldQueryType::nearest;
    for (int i = 0; i < 1'000'000; ++i) {
        request.points.push_back(anywhere(random, {0.0, 0.0}, {1000.0, 1000.0}).translation);
    }
    return world_problem("100,000 polygons of 50 vertices: the nearest of 1,000,000 points",
                         Task::nearest, std::move(scene), std::move(request));
}

Problem rays() {
    tools::Scene scene = benchmark::map_scene(100);
    std::vector<PlacedShape> placed;
    place(scene, placed);
    Rectangle box = placed.front().box;
    for (const PlacedShape& shape : placed) {
        box.min = {std::min(box.min.x, shape.box.min.x), std::min(box.min.y, shape.box.min.y)};
        box.max = {std::max(box.max.x, shape.box.max.x), std::max(box.max.y, shape.box.max.y)};
    }
    Random random(53);
    tools::WorldRequest request;
    request.type = tools::WorldQueryType::rays;
    for (int i = 0; i < 1'000'000; ++i) {
        request.segments.push_back({anywhere(random, box.min, box.max).translation,
                                    anywhere(random, box.min, box.max).translation});
    }
    return world_problem("map x100, 71,900 edges: the first hit of 1,000,000 rays",
                         Task::first_hits, std::move(scene), std::move(request));
}

}  // namespace

std::vector<Problem> all_problems() {
    constexpr double scene_tolerance = 0.01;
    constexpr double coast_tolerance = 0.8;
    const NamedScene scenes[] = {
        {"gears x1", benchmark::gears_scene(1), scene_tolerance},
        {"gears x10", benchmark::gears_scene(10), scene_tolerance},
        {"crowd of 1000", benchmark::crowd_scene(), scene_tolerance},
        {"coast lines separated", benchmark::coast_lines_scene(-0.1), coast_tolerance},
        {"coast lines 1 % overlap", benchmark::coast_lines_scene(0.01), coast_tolerance},
        {"coast lines 10 % overlap", benchmark::coast_lines_scene(0.1), coast_tolerance},
    };
    std::vector<Problem> problems;
    for (const PairTask& task : pair_tasks) {
        for (const NamedScene& scene : scenes) {
            problems.push_back({scene.name + ", " + std::string(tools::name_of(task.task)),
                                task.task, asked_of(scene, task)});
        }
    }
    problems.push_back(
        field_of_each("gears x1, fields 64 x 64", benchmark::gears_scene(1), 2.2, 64));
    problems.push_back(
        field_of_each("gears x10, fields 64 x 64", benchmark::gears_scene(10), 2.2, 64));
    problems.push_back(
        field_of_each("crowd of 1000, fields 32 x 32", benchmark::crowd_scene(), 2.2, 32));
    problems.push_back(field_of_each("Iceland, field 256 x 256", iceland_alone(), 600.0, 256));
    problems.push_back(field_of_each("Iceland, field 1024 x 1024", iceland_alone(), 600.0, 1024));
    for (const auto make : {layout, paths, many_polygons, rays}) {
        problems.push_back(make());
    }
    return problems;
}

}  // namespace nearfield::peers
