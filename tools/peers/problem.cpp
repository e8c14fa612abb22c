#include <tools/peers/problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
    const double pieces = std::ceil(std::hypot(to.x - from.x, to.y - from.y) / spacing);
    for (double piece = 0.0; piece < pieces; piece += 1.0) {
        const double t = piece / pieces;
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
        const double cosine = std::cos(instance.pose.angle);
        const double sine = std::sin(instance.pose.angle);
        const Vector2 by = instance.pose.translation;
        PlacedShape& shape = placed[index];
        shape.rings = scene.shapes[instance.shape].rings;
        for (Ring& ring : shape.rings) {
            for (Vector2& p : ring) {
                p = {cosine * p.x - sine * p.y + by.x, sine * p.x + cosine * p.y + by.y};
            }
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

}  // namespace nearfield::peers
