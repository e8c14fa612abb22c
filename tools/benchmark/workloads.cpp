#include <nearfield/portable_math.hpp>

#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::benchmark {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vector2 polar(double radius, double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {radius * cosine, radius * sine};
}

double share(std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

/// Periodic piecewise linear interpolation of random heights at a fraction of a full turn.
double noise_at(const std::vector<double>& heights, double turn) {
    const double place = turn * static_cast<double>(heights.size());
    const auto before = static_cast<std::size_t>(place) % heights.size();
    const double t = place - std::floor(place);
    return std::lerp(heights[before], heights[(before + 1) % heights.size()], t);
}

/// The centre line of a link at t in [0, 1], offset to its left by `side`.
Vector2 link_point(double t, double side) {
    constexpr double arc = 200.0 / 360.0 * full_turn;
    if (t < 0.5) {  // the left hook, clockwise over the top: its left is outward
        const Vector2 p = polar(1.0 + side, arc * (1.0 - 2.0 * t));
        return {p.x - 1.0, p.y};
    }
    const Vector2 p = polar(1.0 - side, full_turn / 2.0 + arc * (2.0 * t - 1.0));
    return {p.x + 1.0, p.y};
}

}  // namespace

Ring coast(std::uint64_t seed, std::size_t n) {
    std::vector<double> radii(n, 1.0);
    double amplitude = 0.2;
    Random random(seed);
    for (std::size_t heights = 6; heights <= n; heights *= 2) {
        std::vector<double> octave(heights);
        for (double& height : octave) {
            height = random.between(-amplitude, amplitude);
        }
        for (std::size_t i = 0; i < n; ++i) {
            radii[i] += noise_at(octave, share(i, n));
        }
        amplitude *= 0.55;
    }
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        ring.push_back(polar(radii[i], full_turn * share(i, n)));
    }
    return ring;
}

Ring gear(std::size_t teeth) {
    struct Corner {
        double part;
        double radius;
    };
    constexpr Corner corners[] = {{0.0, 0.75}, {0.2, 1.0}, {0.45, 1.0}, {0.65, 0.75}};
    Ring ring;
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
        for (const Corner& corner : corners) {
            const double turn =
                (static_cast<double>(tooth) + corner.part) / static_cast<double>(teeth);
            ring.push_back(polar(corner.radius, full_turn * turn));
        }
    }
    return ring;
}

Ring link(std::size_t n) {
    constexpr double half_width = 0.2;
    const std::size_t left = n - n / 2;
    const std::size_t right = n / 2;
    Ring ring;
    for (std::size_t i = 0; i < left; ++i) {
        ring.push_back(link_point(share(i, left - 1), half_width));
    }
    for (std::size_t i = right; i-- > 0;) {
        ring.push_back(link_point(share(i, right - 1), -half_width));
    }
    return ring;
}

Ring car(std::size_t n) {
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2 p = polar(1.0, full_turn * (share(i, n) + 0.5 / static_cast<double>(n)));
        const double x = p.x * p.x;
        const double y = 4.0 * p.y * p.y;
        const double radius = 1.0 / std::sqrt(std::sqrt(x * x + y * y));
        ring.push_back({radius * p.x, radius * p.y});
    }
    return ring;
}

Ring wavy_bar(std::size_t n, double back, double shift) {
    constexpr double length = 4.0;
    constexpr double waves = 5.0;
    constexpr double amplitude = 0.2;
    Ring ring{{0.0, back}, {length, back}};
    const std::size_t count = n - 2;
    for (std::size_t i = count; i-- > 0;) {
        const double along = share(i, count - 1);
        ring.push_back(
            {length * along, shift + amplitude * sine_cosine(full_turn * waves * along).sine});
    }
    return ring;
}

Ring star(Random& random, std::size_t n) {
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
        ring.push_back(polar(random.between(0.6, 1.0), full_turn * share(i, n)));
    }
    return ring;
}

Ring refined(Random& random, const Ring& ring, std::size_t factor) {
    constexpr double steepest = 0.1;
    Ring finer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 from = ring[i];
        const Vector2 to = ring[(i + 1) % ring.size()];
        for (std::size_t piece = 0; piece < factor; ++piece) {
            const double t = share(piece, factor);
            const double aside = random.between(-steepest, steepest) * std::min(t, 1.0 - t);
            finer.push_back({std::lerp(from.x, to.x, t) - aside * (to.y - from.y),
                             std::lerp(from.y, to.y, t) + aside * (to.x - from.x)});
        }
    }
    return finer;
}

namespace {

constexpr std::size_t star_vertices = 50;

double any_angle(Random& random) {
    return random.between(0.0, 2.0 * std::numbers::pi);
}

void add_star(tools::Scene& scene, Random& random, Vector2 place) {
    Ring ring = star(random, star_vertices);  // fixes the evaluation order: before the angle
    add_object(scene, {std::move(ring)}, {place, any_angle(random)});
}

}  // namespace

tools::Scene crowd_scene(std::size_t objects) {
    constexpr double spacing = 1.716;
    constexpr double jitter = 0.25;
    constexpr double columns_to_rows = 1.6;
    const auto columns = static_cast<std::size_t>(
        std::lround(std::sqrt(columns_to_rows * static_cast<double>(objects))));
    tools::Scene scene;
    Random random(1);
    for (std::size_t index = 0; index < objects; ++index) {
        const Vector2 place = in_rows(index, columns, {spacing, spacing});
        const Vector2 aside{random.between(-jitter, jitter), random.between(-jitter, jitter)};
        add_star(scene, random, {place.x + aside.x, place.y + aside.y});
    }
    return scene;
}

tools::Scene small_pairs_scene(std::size_t pairs) {
    constexpr double apart = 1.3;
    tools::Scene scene;
    Random random(3);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const Vector2 place = in_rows(pair, 100, {5.0, 5.0});
        add_star(scene, random, place);
        const double angle = any_angle(random);
        const auto [sine, cosine] = sine_cosine(angle);
        add_star(scene, random, {place.x + apart * cosine, place.y + apart * sine});
    }
    return scene;
}

namespace {

struct Edge {
    Vector2 from;
    Vector2 to;
};

std::vector<Edge> edges_of(const std::vector<Ring>& rings) {
    std::vector<Edge> edges;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
        }
    }
    return edges;
}

/// The signed distance along x from the point to the edge at the point's height; `nothing` if the
/// edge does not span that height.
double ahead_of(Vector2 point, const Edge& edge, double nothing) {
    if (point.y < std::min(edge.from.y, edge.to.y) || point.y > std::max(edge.from.y, edge.to.y)) {
        return nothing;
    }
    if (edge.from.y == edge.to.y) {
        return std::min(edge.from.x, edge.to.x) - point.x;
    }
    const double t = (point.y - edge.from.y) / (edge.to.y - edge.from.y);
    return std::lerp(edge.from.x, edge.to.x, t) - point.x;
}

/// GeoJSON closes its rings with the first vertex again.
std::vector<Ring> opened(std::vector<Ring> rings) {
    for (Ring& ring : rings) {
        if (ring.front() == ring.back()) {
            ring.pop_back();
        }
    }
    return rings;
}

double width_of(const std::vector<Ring>& rings) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            low = std::min(low, vertex.x);
            high = std::max(high, vertex.x);
        }
    }
    return high - low;
}

}  // namespace

std::vector<Ring> iceland() {
    return opened(tools::parse_geojson(embedded::iceland_10m, "iceland_10m.geojson"));
}

std::vector<Ring> ireland() {
    return opened(tools::parse_geojson(embedded::ireland_10m, "ireland_10m.geojson"));
}

double gap_along_x(const std::vector<Ring>& a, const std::vector<Ring>& b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // The smallest gap is attained at a vertex of one of the two outlines.
    double gap = infinity;
    const std::vector<Edge> edges_a = edges_of(a);
    const std::vector<Edge> edges_b = edges_of(b);
    for (const Edge& edge_a : edges_a) {
        for (const Edge& edge_b : edges_b) {
            gap = std::min(gap, ahead_of(edge_a.from, edge_b, infinity));
            gap = std::min(gap, -ahead_of(edge_b.from, edge_a, -infinity));
        }
    }
    return gap;
}

tools::Scene coast_lines_scene(double overlap) {
    const std::vector<Ring> a = iceland();
    std::vector<Ring> b = ireland();
    const double width = width_of(a);
    // B starts to the right of all of A, so that the first touch is the relevant one.
    const double start = width + width_of(b);
    for (Ring& ring : b) {
        for (Vector2& vertex : ring) {
            vertex.x += start;
        }
    }
    const double gap = gap_along_x(a, b);
    tools::Scene scene;
    add_object(scene, a, {});
    add_object(scene, ireland(), {{start - gap - overlap * width, 0.0}, 0.0});
    return scene;
}

tools::Scene map_scene(std::size_t scale) {
    tools::Scene scene;
    for (std::size_t index = 0; index < 6; ++index) {
        const std::size_t vertices = index == 5 ? 119 : 120;
        add_object(scene, {coast(index + 1, scale * vertices)},
                   {in_rows(index, 3, {1.95, 1.95}), 0.0});
    }
    return scene;
}

tools::Scene gears_scene(std::size_t scale) {
    tools::Scene scene;
    Random random(1);
    for (std::size_t index = 0; index < 13; ++index) {
        std::vector<Ring> rings{gear(index % 2 == 1 ? 8 : 7)};
        if (index == 0) {
            rings.push_back({{0.2, 0.0}, {-0.1, 0.15}, {-0.1, -0.15}});
        }
        for (Ring& ring : rings) {
            ring = refined(random, ring, scale);
        }
        const Vector2 place = index < 12 ? in_rows(index, 4, {1.8, 1.8}) : Vector2{7.2, 0.0};
        add_object(scene, std::move(rings),
                   tools::to_pose({place.x, place.y, 11.0 * static_cast<double>(index)}));
    }
    return scene;
}

tools::Scene links_scene(std::size_t scale) {
    constexpr double height_less_a_touch = 2.38;
    tools::Scene scene;
    for (std::size_t index = 0; index < 15; ++index) {
        const std::size_t vertices = index % 3 == 0 ? 30 : 29;
        add_object(scene, {link(scale * vertices)},
                   {in_rows(index, 5, {link_pitch, height_less_a_touch}), 0.0});
    }
    return scene;
}

tools::Scene cars_scene(std::size_t scale) {
    tools::Scene scene;
    Random random(2);
    for (std::size_t index = 0; index < 18; ++index) {
        const std::size_t vertices = index < 14 ? 15 : 14;
        const Vector2 place = in_rows(index, 6, {2.05, 1.15});
        add_object(scene, {car(scale * vertices)},
                   {{place.x + random.between(-0.1, 0.1), place.y + random.between(-0.1, 0.1)},
                    random.between(-0.1, 0.1)});
    }
    return scene;
}

tools::Scene wavy_scene(std::size_t scale) {
    constexpr double pressed_in = 0.03;
    tools::Scene scene;
    add_object(scene, {wavy_bar(scale * 100, -1.0, pressed_in / 2.0)}, {});
    add_object(scene, {wavy_bar(scale * 100, 1.0, -pressed_in / 2.0)}, {});
    return scene;
}

namespace {

tools::QueryRequest request_of(tools::QueryType type, double tolerance) {
    tools::QueryRequest request;
    request.type = type;
    request.tolerance = tolerance;
    return request;
}

}  // namespace

tools::QueryRequest vertex_penetration(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::penetration, tolerance);
    request.points = PenetrationPoints::vertices;
    request.records = false;
    return request;
}

tools::QueryRequest boundary_penetration(double tolerance) {
    return request_of(tools::QueryType::penetration, tolerance);
}

tools::QueryRequest contacts(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::contacts, tolerance);
    request.contact_distance = 2.0 * tolerance;
    return request;
}

tools::QueryRequest separation(double tolerance) {
    return request_of(tools::QueryType::separation, tolerance);
}

tools::QueryRequest intersection_test(double /*tolerance*/) {
    return request_of(tools::QueryType::intersection_test, 0.0);
}

tools::QueryRequest intersection(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::intersection, tolerance);
    request.records = false;
    return request;
}

tools::QueryRequest square_field(Vector2 middle, double side, std::size_t cells) {
    const double cell = side / static_cast<double>(cells);
    tools::QueryRequest request =
        request_of(tools::QueryType::distance_field, cell / std::numbers::sqrt2);
    const double half = side / 2.0;
    request.rectangle =
        Rectangle{{middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}};
    return request;
}

tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request, Pairs pairs) {
    if (pairs == Pairs::all) {
        // A simulation does not need pairs farther apart than this.
        constexpr double reach_in_tolerances = 20.0;
        const double reach = request.type == tools::QueryType::separation
                                 ? reach_in_tolerances * request.tolerance
                                 : 0.0;
        scene.queries.push_back({request, 0, 0, true, reach});
        return scene;
    }
    for (std::size_t a = 0; a + 1 < scene.instances.size(); a += 2) {
        scene.queries.push_back({request, a, a + 1});
    }
    return scene;
}

tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request, std::size_t a,
                   std::size_t b) {
    scene.queries.push_back({request, a, b});
    return scene;
}

namespace {

using MakeScene = std::function<tools::Scene()>;
using MakeRequest = tools::QueryRequest (*)(double tolerance);

/// The tolerance d for scenes with objects of radius about 1, and for the coast lines in
/// kilometres.
constexpr double scene_tolerance = 0.01;
constexpr double coast_tolerance = 0.8;

struct Question {
    const char* name;
    MakeRequest request;
};

constexpr Question questions[] = {
    {"vertices", vertex_penetration}, {"boundary", boundary_penetration},
    {"contacts", contacts},           {"separation", separation},
    {"intersection", intersection},   {"test", intersection_test},
};

/// Adds every kind of query between all nearby pairs.
void add_questions(std::vector<Row>& rows, const std::string& name, const MakeScene& scene,
                   double tolerance, Pairs pairs) {
    for (const Question& question : questions) {
        rows.push_back({name + ", " + question.name,
                        [=] { return asked(scene(), question.request(tolerance), pairs); }});
    }
}

void add_paper_scenes(std::vector<Row>& rows) {
    struct PaperScene {
        const char* name;
        tools::Scene (*make)(std::size_t scale);
    };
    constexpr PaperScene scenes[] = {{"map", map_scene},
                                     {"gears", gears_scene},
                                     {"links", links_scene},
                                     {"cars", cars_scene},
                                     {"wavy", wavy_scene}};
    for (const PaperScene& scene : scenes) {
        for (const std::size_t scale : {1U, 10U, 100U}) {
            add_questions(
                rows, std::string(scene.name) + " x" + std::to_string(scale),
                [=] { return scene.make(scale); }, scene_tolerance, Pairs::all);
        }
    }
}

void add_coast_lines(std::vector<Row>& rows) {
    struct Position {
        const char* name;
        double overlap;
    };
    constexpr Position positions[] = {
        {"separated", -0.1}, {"touching", 0.0}, {"1 % overlap", 0.01}, {"10 % overlap", 0.1}};
    for (const Position& position : positions) {
        add_questions(
            rows, std::string("coast lines ") + position.name,
            [=] { return coast_lines_scene(position.overlap); }, coast_tolerance, Pairs::neighbors);
    }
}

tools::Scene alone(std::vector<Ring> rings) {
    tools::Scene scene;
    add_object(scene, std::move(rings), {});
    return scene;
}

void add_fields_by_cells(std::vector<Row>& rows) {
    constexpr double window = 600.0;  // covers Iceland
    for (const std::size_t cells : {64U, 128U, 256U, 512U, 1024U, 2048U}) {
        const std::string size = std::to_string(cells) + " x " + std::to_string(cells);
        rows.push_back({"field " + size + ", Iceland", [=] {
                            return asked(alone(iceland()), square_field({}, window, cells), 0, 0);
                        }});
    }
    rows.push_back({"field 1024 x 1024, 8000 vertices", [] {
                        return asked(alone({coast(1, 8000)}), square_field({}, 3.0, 1024), 0, 0);
                    }});
}

/// The window and d are fixed: the work depends on the tolerance, not on the vertices.
void add_fields_by_vertices(std::vector<Row>& rows) {
    constexpr std::size_t cells = 256;
    constexpr double window = 3.0;
    for (const std::size_t n : {200U, 600U, 2000U, 6000U, 20000U}) {
        const std::string count = std::to_string(n) + " vertices";
        rows.push_back(
            {"coast of " + count + ", field 256 x 256",
             [=] { return asked(alone({coast(1, n)}), square_field({}, window, cells), 0, 0); }});
        rows.push_back({"coast of " + count + ", boundary", [=] {
                            tools::Scene scene = alone({coast(1, n)});
                            add_object(scene, {coast(2, n)}, {{1.6, 0.0}, 0.0});
                            return asked(std::move(scene), boundary_penetration(scene_tolerance), 0,
                                         1);
                        }});
    }
}

void add_crowds(std::vector<Row>& rows) {
    add_questions(
        rows, "crowd of 1000", [] { return crowd_scene(); }, scene_tolerance, Pairs::all);
    // The box of the intersection of two stars is about 32 x 32 cells of this size.
    constexpr double pair_tolerance = 0.03;
    add_questions(
        rows, "1000 small pairs", [] { return small_pairs_scene(1000); }, pair_tolerance,
        Pairs::neighbors);
    rows.push_back({"1000 small pairs, field 32 x 32", [] {
                        constexpr std::size_t cells = 32;
                        constexpr double window = 2.0;
                        tools::Scene scene = small_pairs_scene(1000);
                        for (std::size_t b = 0; b < scene.instances.size(); b += 2) {
                            const Vector2 middle = scene.instances[b].pose.translation;
                            scene.queries.push_back({square_field(middle, window, cells), b, b});
                        }
                        return scene;
                    }});
    rows.push_back({"10000 small pairs, vertices", [] {
                        return asked(small_pairs_scene(10000), vertex_penetration(pair_tolerance),
                                     Pairs::neighbors);
                    }});
}

/// Table 3 of the paper.
void add_tolerances(std::vector<Row>& rows) {
    struct Tolerance {
        const char* name;
        double factor;
    };
    constexpr Tolerance tolerances[] = {
        {"d/4", 0.25}, {"d/2", 0.5}, {"d", 1.0}, {"2d", 2.0}, {"4d", 4.0}};
    for (const Question& question : {questions[1], questions[4]}) {
        for (const Tolerance& tolerance : tolerances) {
            rows.push_back({std::string("wavy at ") + tolerance.name + ", " + question.name, [=] {
                                return asked(wavy_scene(1),
                                             question.request(tolerance.factor * scene_tolerance),
                                             Pairs::all);
                            }});
        }
    }
}

}  // namespace

std::vector<Row> standard_table() {
    std::vector<Row> rows;
    add_paper_scenes(rows);
    add_crowds(rows);
    add_coast_lines(rows);
    add_fields_by_cells(rows);
    add_fields_by_vertices(rows);
    add_tolerances(rows);
    return rows;
}

}  // namespace nearfield::benchmark
