#include <tools/simulation/deformable_body.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/scenes.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::simulation {
namespace {

constexpr std::size_t vertices = 100;

/// A rectangle with round corners and equally spaced vertices.
Ring bar(Rectangle box) {
    constexpr double corner = 0.3;
    constexpr double quarter = std::numbers::pi / 2.0;
    const double width = box.max.x - box.min.x - 2.0 * corner;
    const double height = box.max.y - box.min.y - 2.0 * corner;
    const double perimeter = 2.0 * (width + height) + 4.0 * quarter * corner;
    // The four sides counter-clockwise from the lower right, each followed by its corner.
    struct Side {
        Vector2 from;
        double length;
        double direction;
    };
    const Side sides[] = {{{box.max.x, box.min.y + corner}, height, quarter},
                          {{box.max.x - corner, box.max.y}, width, 2.0 * quarter},
                          {{box.min.x, box.max.y - corner}, height, 3.0 * quarter},
                          {{box.min.x + corner, box.min.y}, width, 0.0}};
    Ring ring;
    for (std::size_t i = 0; i < vertices; ++i) {
        double along = perimeter * static_cast<double>(i) / static_cast<double>(vertices);
        std::size_t index = 0;
        while (along >= sides[index].length + quarter * corner) {
            along -= sides[index].length + quarter * corner;
            ++index;
        }
        const Side& side = sides[index];
        const double straight = std::min(along, side.length);
        const double bend = (along - straight) / corner;
        const Vector2 end = side.from + straight * polar(1.0, side.direction);
        const Vector2 middle = end + corner * polar(1.0, side.direction + quarter);
        ring.push_back(middle + corner * polar(1.0, side.direction - quarter + bend));
    }
    return ring;
}

/// Falls from 1 at 0 to 0 at 4, almost like the exponential of -x^2.
double bump(double x) {
    double value = std::max(0.0, 1.0 - x * x / 16.0);
    for (int i = 0; i < 4; ++i) {
        value *= value;
    }
    return value;
}

/// Marks the vertices beyond a vertical line, on the side given by `sign`.
std::vector<bool> beyond(const Ring& ring, double x, double sign) {
    std::vector<bool> held;
    for (const Vector2& vertex : ring) {
        held.push_back(sign * (vertex.x - x) > 0.0);
    }
    return held;
}

constexpr Softness softness{1.0, 12.0, 0.5, 20.0, 0.006};

}  // namespace

Scene wavy_scene() {
    constexpr double half_a_gap = 0.01;
    constexpr double back = 1.3;
    Scene scene;
    scene.name = "wavy";
    const Ring left = bar({{-half_a_gap - back, -1.2}, {-half_a_gap, 3.0}});
    const Ring right = bar({{half_a_gap, -3.0}, {half_a_gap + back, 1.2}});
    scene.bodies.push_back(
        std::make_unique<DeformableBody>(left, softness, beyond(left, -back, -1.0)));
    auto waving = std::make_unique<DeformableBody>(right, softness, beyond(right, back, 1.0));
    DeformableBody* const source = waving.get();
    scene.bodies.push_back(std::move(waving));
    scene.looks = {{0.05}, {0.6}};
    scene.touch = {400.0, 1.0, 0.0, 0.2};
    scene.steps = 8;
    scene.act = [source](double time) {
        // A short push to the left, low on the free face, every few seconds.
        constexpr double every = 5.0;
        constexpr double strength = 0.75;
        const double since = (std::fmod(time, every) - 0.3) / 0.1;
        const double now = strength * bump(since);
        for (std::size_t i = 0; i < vertices; ++i) {
            const Vector2 place = source->rest()[i] + Vector2{0.66, -0.9};
            const double away = (place.y + 2.4) / 0.25;
            if (place.x < 0.2) {
                source->push_vertex(i, {-now * bump(away), 0.0});
            }
        }
    };
    scene.view = {{-3.4, -3.3}, {3.4, 3.3}};
    return scene;
}

Scene overlap_scene() {
    Scene scene;
    scene.name = "overlap";
    constexpr Softness soft{1.0, 12.0, 6.0, 20.0, 0.03};
    scene.bodies.push_back(std::make_unique<DeformableBody>(bar({{-1.6, -1.5}, {0.3, 1.9}}), soft));
    scene.bodies.push_back(std::make_unique<DeformableBody>(bar({{-0.3, -1.9}, {1.6, 1.5}}), soft));
    scene.looks = {{0.05}, {0.6}};
    scene.surroundings.attraction = 0.5;
    scene.surroundings.drag = 0.6;
    scene.touch = {40.0, 2.0, 0.0, 0.2};
    scene.steps = 8;
    scene.view = {{-4.0, -3.0}, {4.0, 3.0}};
    return scene;
}

}  // namespace nearfield::simulation
