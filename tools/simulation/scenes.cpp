#include <embedded/austria_50m.hpp>
#include <embedded/cuba_50m.hpp>
#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <embedded/sri_lanka_10m.hpp>
#include <embedded/sweden_50m.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/simulation/deformable_body.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace nearfield::simulation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pitch_radius_by_teeth = 0.125;

double pitch_radius(std::size_t teeth) {
    return pitch_radius_by_teeth * static_cast<double>(teeth);
}

/// A gear that meshes with its driver and lies in the direction `toward` from it: it has a gap
/// where the driver has a tooth.
TrainGear driven(const std::vector<TrainGear>& train, std::size_t driver, std::size_t teeth,
                 double toward) {
    const TrainGear& before = train[driver];
    const double pitch = 2.0 * pi / static_cast<double>(teeth);
    const double past_a_tooth =
        (toward - before.angle) * static_cast<double>(before.teeth) / (2.0 * pi);
    const double part = past_a_tooth - std::floor(past_a_tooth);
    return {teeth, driver,
            simulation::operator+(
                before.place,
                simulation::polar(pitch_radius(before.teeth) + pitch_radius(teeth), toward)),
            toward + pi + (part + 0.5) * pitch};
}

}  // namespace

Ring gear_outline(std::size_t teeth) {
    constexpr double tip = 0.18;   // beyond the pitch radius
    constexpr double root = 0.28;  // inside it
    struct Corner {
        double part;  // in pitches, from the middle of the tooth
        double height;
    };
    constexpr Corner corners[] = {{-0.27, -root}, {-0.11, tip}, {0.11, tip}, {0.27, -root}};
    Ring ring;
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
        for (const Corner& corner : corners) {
            const double turn =
                (static_cast<double>(tooth) + corner.part) / static_cast<double>(teeth);
            ring.push_back(simulation::polar(pitch_radius(teeth) + corner.height, 2.0 * pi * turn));
        }
    }
    return ring;
}

std::vector<TrainGear> gear_train() {
    std::vector<TrainGear> train{{9, 0, {}, 0.0}};
    for (std::size_t arm = 0; arm < 4; ++arm) {
        const double outward = pi / 4.0 + pi / 2.0 * static_cast<double>(arm);
        train.push_back(driven(train, 0, 8, outward));
    }
    for (std::size_t arm = 0; arm < 4; ++arm) {
        const double outward = pi / 4.0 + pi / 2.0 * static_cast<double>(arm);
        const double aside = 55.0 / 180.0 * pi;
        train.push_back(driven(train, 1 + arm, 6, outward - aside));
        train.push_back(driven(train, 1 + arm, 8, outward + aside));
    }
    return train;
}

namespace {

using simulation::cross;
using simulation::operator-;
using simulation::operator*;

bool edges_cross(Vector2 a, Vector2 b, Vector2 c, Vector2 d) {
    return cross(b - a, c - a) * cross(b - a, d - a) <= 0.0 &&
           cross(d - c, a - c) * cross(d - c, b - c) <= 0.0;
}

/// True if the edge that replaces a vertex crosses an edge other than its two neighbours.
bool crosses_without(const Ring& ring, std::size_t vertex) {
    const std::size_t n = ring.size();
    const std::size_t before = (vertex + n - 1) % n;
    const std::size_t after = (vertex + 1) % n;
    for (std::size_t step = 1; step + 3 < n; ++step) {
        const std::size_t from = (after + step) % n;
        const std::size_t to = (from + 1) % n;
        if (to != before && edges_cross(ring[before], ring[after], ring[from], ring[to])) {
            return true;
        }
    }
    return false;
}

/// The vertex with the smallest triangle among those that are not needed.
std::size_t min_vertex(const Ring& ring, const std::vector<bool>& needed) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t chosen = 0;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2 before = ring[i == 0 ? n - 1 : i - 1];
        const Vector2 after = ring[i + 1 == n ? 0 : i + 1];
        const double area = std::abs(cross(ring[i] - before, after - before));
        if (area < least && !needed[i]) {
            least = area;
            chosen = i;
        }
    }
    return chosen;
}

/// Removes vertices from a ring until `count` are left: first those whose triangle with their
/// neighbours is smallest, and none whose removal would make the ring cross itself. Precondition:
/// the ring does not cross itself and has more vertices than it needs for that; `count` >= 3.
Ring thinned(Ring ring, std::size_t count) {
    std::vector<bool> needed(ring.size(), false);
    while (ring.size() > count) {
        const std::size_t chosen = min_vertex(ring, needed);
        if (crosses_without(ring, chosen)) {
            needed[chosen] = true;
            continue;
        }
        const auto place = static_cast<std::ptrdiff_t>(chosen);
        ring.erase(ring.begin() + place);
        needed.erase(needed.begin() + place);
    }
    return ring;
}

Ring country(const std::string& text, std::size_t vertices, double area) {
    Ring ring = tools::parse_geojson(text, "country").front();
    if (ring.front() == ring.back()) {
        ring.pop_back();
    }
    ring = thinned(std::move(ring), vertices);
    const MassProperties plate = simulation::mass_properties(std::span(&ring, 1));
    for (Vector2& vertex : ring) {
        vertex = std::sqrt(area / plate.area) * (vertex - plate.centroid);
    }
    return ring;
}

}  // namespace

std::vector<Ring> countries(double area) {
    return {country(embedded::iceland_10m, 120, area),   country(embedded::ireland_10m, 120, area),
            country(embedded::austria_50m, 120, area),   country(embedded::sweden_50m, 120, area),
            country(embedded::sri_lanka_10m, 119, area), country(embedded::cuba_50m, 120, area)};
}

Scene gears_scene() {
    Scene scene;
    scene.name = "gears";
    std::size_t number = 0;
    for (const TrainGear& gear : gear_train()) {
        const bool driver = number == 0;
        std::vector<Ring> rings{gear_outline(gear.teeth)};
        if (driver) {  // its shaft has three sides
            rings.push_back({polar(0.3, 0.0), polar(0.3, 2.0 * std::numbers::pi / 3.0),
                             polar(0.3, 4.0 * std::numbers::pi / 3.0)});
        }
        auto body = std::make_unique<RigidBody>(std::move(rings), Pose{gear.place, gear.angle},
                                                driver ? Freedom::directed : Freedom::turning);
        if (driver) {
            scene.act = [motor = body.get()](double time) {
                motor->set_motion({}, driver_spin * std::min(1.0, time));
            };
        }
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({driver ? 0.08 : 0.5 + 0.03 * static_cast<double>(gear.teeth)});
        ++number;
    }
    scene.surroundings.drag = 0.5;
    scene.touch = {30000.0, 300.0, 0.0, 0.05};
    scene.steps = 6;
    scene.view = {{-5.6, -4.9}, {5.6, 4.9}};
    return scene;
}

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double link_length = 1.0;  // from the middle of the socket to that of the ball

void add_arc(Ring& ring, Vector2 middle, double radius, double from, double to,
             std::size_t vertices) {
    for (std::size_t i = 0; i < vertices; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(vertices - 1);
        ring.push_back(middle + polar(radius, degree * std::lerp(from, to, part)));
    }
}

/// A socket about the origin, open at the top, and below it a ball that fits into a socket but not
/// through its opening.
Ring link_outline(std::size_t ball_vertices) {
    constexpr double opening = 38.0;  // degrees on either side of straight up
    constexpr double inner = 0.205;
    constexpr double outer = 0.33;
    constexpr double ball = 0.175;
    constexpr double neck = 20.0;  // degrees on either side, at the socket and at the ball
    Ring ring;
    add_arc(ring, {}, inner, 90.0 - opening, -270.0 + opening, 9);
    add_arc(ring, {}, outer, 90.0 + opening, 270.0 - neck / 2.0, 5);
    add_arc(ring, {0.0, -link_length}, ball, 90.0 + neck, 450.0 - neck, ball_vertices);
    add_arc(ring, {}, outer, 270.0 + neck / 2.0, 450.0 - opening, 5);
    return ring;
}

}  // namespace

Scene links_scene() {
    constexpr std::size_t links = 15;
    constexpr double turn = 12.5 * degree;  // from link to link
    Scene scene;
    scene.name = "links";
    Vector2 socket{-4.6, 2.2};
    std::vector<RigidBody*> ends;
    for (std::size_t i = 0; i < links; ++i) {
        const bool end = i == 0 || i + 1 == links;
        // 0 is straight down: the chain goes downwards from one end and comes up to the other.
        const double lean = turn * (static_cast<double>(i) - static_cast<double>(links - 1) / 2.0) +
                            std::numbers::pi / 2.0;
        auto body = std::make_unique<RigidBody>(
            std::vector<Ring>{link_outline(i % 3 == 0 ? 11 : 10)}, Pose{socket, lean},
            end ? Freedom::directed : Freedom::free);
        if (end) {
            ends.push_back(body.get());
        }
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({end ? 0.08 : 0.55 + 0.2 * static_cast<double>(i % 2)});
        socket += polar(link_length, lean - std::numbers::pi / 2.0);
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.surroundings.drag = 0.1;
    scene.touch = {60000.0, 80.0, 0.1, 0.1};
    scene.steps = 10;
    scene.act = [ends](double time) {
        constexpr double reach = 0.7;
        constexpr double pace = 2.2;  // radians per second
        const double speed = reach * pace * sine_cosine(pace * time).sine;
        ends.front()->set_motion({speed, 0.0}, 0.0);
        ends.back()->set_motion({0.0, 0.6 * speed}, 0.0);
    };
    scene.view = {{-6.0, -4.2}, {6.0, 4.2}};
    return scene;
}

namespace {

constexpr std::size_t cars = 18;
constexpr std::size_t lanes = 3;
constexpr double turn = 2.0 * std::numbers::pi;
constexpr Vector2 course_middle{0.0, 0.2};

/// The planned motion of a car around the course: a lane from which it weaves a little, and its
/// scheduled position. Inner lanes are faster, so cars pass each other all the time.
struct Driver {
    double lane = 0.0;   // offset from the middle lane, outwards
    double start = 0.0;  // angle on the course
    double pace = 0.0;   // radians per second
    double mood = 0.0;   // phase of the weaving

    [[nodiscard]] double angle(double time) const {
        return start + pace * time + 0.2 * sine_cosine(0.9 * time + 3.0 * mood).sine;
    }
    [[nodiscard]] Vector2 radii(double time) const {
        // In lane at the start.
        const double beside =
            lane + 0.35 * std::min(1.0, time) * sine_cosine(0.7 * time + mood).sine;
        return {4.3 + beside, 3.1 + beside};
    }
    [[nodiscard]] Vector2 place(double angle, double time) const {
        const Vector2 around = radii(time);
        const auto [sine, cosine] = sine_cosine(angle);
        return course_middle + Vector2{around.x * cosine, around.y * sine};
    }
};

Driver driver_of(std::size_t car) {
    constexpr double lane_width = 0.85;
    constexpr std::size_t per_lane = cars / lanes;
    const std::size_t row = car / lanes;
    const auto lane = static_cast<double>(car % lanes);
    const double slot = static_cast<double>(row) + lane / 3.0;
    return {lane_width * (lane - 1.0), turn * slot / static_cast<double>(per_lane),
            0.62 - 0.13 * lane, 2.4 * static_cast<double>(car)};
}

/// Wheels roll along the car and hardly slip sideways. The car steers towards a point of its lane a
/// little ahead, and drives faster the further it is behind schedule.
void drive(RigidBody& car, const Driver& driver, double time) {
    constexpr double grip = 6.0;      // sideways deceleration per speed
    constexpr double engine = 4.0;    // maximum acceleration and braking deceleration
    constexpr double response = 4.0;  // acceleration per missing speed
    constexpr double fastest = 3.2;
    constexpr double steering = 14.0;  // angular acceleration per angular error
    constexpr double settling = 6.0;   // and per spin
    constexpr double look_ahead = 0.3;
    const Vector2 around = driver.radii(time);
    const Vector2 arm = car.center() - course_middle;
    const double angle = arc_tangent(arm.y / around.y, arm.x / around.x);
    const Vector2 way = driver.place(angle + look_ahead, time) - car.center();
    const Vector2 ahead = polar(1.0, car.angle());
    const Vector2 side = left_of(ahead);
    const double error = arc_tangent(cross(ahead, way), dot(ahead, way));
    const double behind = std::remainder(driver.angle(time) - angle, turn);
    const double radius = length(arm);
    const double wanted = std::clamp(radius * (driver.pace + 1.2 * behind), 0.3, fastest) *
                          std::max(0.25, sine_cosine(error).cosine);
    const Vector2 velocity = car.velocity();
    const double throttle = std::clamp(response * (wanted - dot(velocity, ahead)), -engine, engine);
    car.pull(throttle * ahead - (grip * dot(velocity, side)) * side);
    car.twist(car.inertia() * (steering * std::clamp(error, -0.8, 0.8) - settling * car.spin()));
}

Ring car_outline(std::size_t vertices) {
    constexpr double size = 0.62;
    Ring ring = benchmark::car(vertices);
    for (Vector2& vertex : ring) {
        vertex = size * vertex;
    }
    return ring;
}

}  // namespace

Scene cars_scene() {
    Scene scene;
    scene.name = "cars";
    std::vector<RigidBody*> bodies;
    for (std::size_t i = 0; i < cars; ++i) {
        const Driver driver = driver_of(i);
        const Vector2 place = driver.place(driver.start, 0.0);
        const Vector2 way = driver.place(driver.start + 0.01, 0.0) - place;
        auto body = std::make_unique<RigidBody>(std::vector<Ring>{car_outline(i < 14 ? 15 : 14)},
                                                Pose{place, arc_tangent(way.y, way.x)});
        bodies.push_back(body.get());
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({static_cast<double>(i) * 0.618, 0.42});
    }
    scene.touch = {12000.0, 60.0, 0.5, 0.2};
    scene.act = [bodies](double time) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            drive(*bodies[i], driver_of(i), time);
        }
    };
    scene.view = {{-6.3, -4.5}, {6.3, 4.9}};
    return scene;
}

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

Scene map_scene() {
    Scene scene;
    scene.name = "map";
    std::vector<Ring> outlines = countries(3.0);
    std::vector<RigidBody*> bodies;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const double turn = static_cast<double>(i) / static_cast<double>(outlines.size());
        const Pose pose{polar(3.9, 2.0 * std::numbers::pi * turn),
                        0.6 * sine_cosine(5.0 * turn).sine};
        auto body = std::make_unique<RigidBody>(std::vector<Ring>{std::move(outlines[i])}, pose);
        bodies.push_back(body.get());
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({0.12 + turn});
    }
    scene.surroundings.attraction = 1.0;
    scene.surroundings.drag = 0.15;
    scene.touch = {6000.0, 60.0, 0.2, 0.2};
    scene.steps = 6;
    scene.act = [bodies](double time) {
        // Stirs in both directions, the outer bodies as strongly as the inner ones.
        constexpr double strength = 1.2;
        const double stir = strength * sine_cosine(0.9 * time).sine;
        for (RigidBody* body : bodies) {
            const double distance = length(body->center());
            body->pull((stir / (1.0 + distance)) * left_of(body->center()));
        }
    };
    scene.view = {{-4.8, -4.0}, {4.8, 4.0}};
    return scene;
}

namespace {

Ring star(double size, std::size_t points) {
    Ring ring;
    for (std::size_t i = 0; i < 2 * points; ++i) {
        const double angle =
            std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
        ring.push_back(polar(i % 2 == 0 ? size : 0.55 * size, angle));
    }
    return ring;
}

}  // namespace

Scene pour_scene(std::size_t bodies) {
    constexpr double half_width = 8.0;
    constexpr double floor = -7.0;
    constexpr double wall = 1.0;
    constexpr std::size_t columns = 20;
    Scene scene;
    scene.name = "pour";
    // A container that is open at the top.
    const Ring container{{-half_width - wall, floor - wall},
                         {half_width + wall, floor - wall},
                         {half_width + wall, 7.0},
                         {half_width, 7.0},
                         {half_width, floor},
                         {-half_width, floor},
                         {-half_width, 7.0},
                         {-half_width - wall, 7.0}};
    scene.bodies.push_back(
        std::make_unique<RigidBody>(std::vector<Ring>{container}, Pose{}, Freedom::directed));
    scene.looks.push_back({0.6});
    benchmark::Random random(6);
    for (std::size_t i = 0; i < bodies; ++i) {
        const std::size_t row = i / columns;
        const Vector2 place{
            0.7 * (static_cast<double>(i % columns) - 0.5 * static_cast<double>(columns - 1)) +
                random.between(-0.05, 0.05),
            floor + 1.0 + 0.7 * static_cast<double>(row)};
        scene.bodies.push_back(
            std::make_unique<RigidBody>(std::vector<Ring>{star(random.between(0.24, 0.32), 5)},
                                        Pose{place, random.between(0.0, std::numbers::pi)}));
        scene.looks.push_back({random.between(0.0, 1.0)});
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.surroundings.drag = 1.0;
    scene.touch = {2500.0, 16.0, 0.3, 0.1};
    // Short enough for stability: with springs about a star on all sides, and those of its
    // neighbours, frequency * time is about 1.
    scene.frame_time = 1.0 / 240.0;
    scene.steps = 1;
    scene.view = {{-10.0, -8.5}, {10.0, 8.5}};
    return scene;
}

namespace {

constexpr NamedScene scenes[] = {
    {"map", map_scene},
    {"gears", gears_scene},
    {"links", links_scene},
    {"cars", cars_scene},
    {"wavy", wavy_scene},
    {"overlap", overlap_scene},
    {"pour", [] { return pour_scene(); }},
};

}  // namespace

std::span<const NamedScene> all_scenes() {
    return scenes;
}

std::span<const NamedScene> paper_scenes() {
    return std::span(scenes).first(5);
}

}  // namespace nearfield::simulation
