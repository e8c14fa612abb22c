#include <tools/benchmark/table.hpp>
#include <tools/benchmark/workloads.hpp>

#include <cstddef>
#include <utility>

namespace nearfield::benchmark {
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
