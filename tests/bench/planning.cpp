// The CPU time for planning a batch and building its tile batches, without a device: many pairs, a
// tolerance that gives thousands of tiles, a large field, a large shape in many queries.

#include <engine/device_input/planner.hpp>
#include <engine/raster/drawn_batch_builder.hpp>
#include <engine/raster/point_planner.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/outlines.hpp>
#include <tests/support/planned_queries.hpp>

#include <deque>
#include <filesystem>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield::bench {
namespace {

using test::Random;

struct Scene {
    std::deque<geometry::Polygon> shapes;
    std::vector<AnyQuery> queries;

    ShapeHandle add(const test::Rings& rings) {
        if (const Status status = shapes.emplace_back().assign(rings); !status.ok()) {
            throw std::runtime_error(status.text());
        }
        return {static_cast<std::uint32_t>(shapes.size() - 1), 0};
    }
};

Scene pairs(PenetrationPoints points) {
    Scene scene;
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        scene.add(test::star(random, 50, 0.4));
    }
    const auto any = [&](double x) {
        return Instance{{static_cast<std::uint32_t>(random.whole(0, 999)), 0},
                        {{x, 0.0}, random.between(0.0, 2.0 * std::numbers::pi)}};
    };
    for (int i = 0; i < 10000; ++i) {
        PenetrationQuery query;
        query.a = any(0.0);
        query.b = any(1.2);
        query.tolerance = 0.02;
        query.points = points;
        query.technique = Technique::raster;
        scene.queries.emplace_back(query);
    }
    return scene;
}

Scene outlines(const std::filesystem::path& data) {
    Scene scene;
    PenetrationQuery query;
    query.a = {scene.add(test::read_outline(data / "iceland_10m.geojson").rings), {}};
    query.b = {scene.add(test::read_outline(data / "ireland_10m.geojson").rings),
               {{120.0, 20.0}, std::numbers::pi / 6.0}};
    query.tolerance = 0.005;
    query.technique = Technique::raster;
    scene.queries.emplace_back(query);
    return scene;
}

Scene field() {
    Scene scene;
    Random random(2);
    DistanceFieldQuery query;
    query.b = {scene.add(test::coast(random, 20000, 0.5)), {{}, 0.2}};
    query.rectangle = Rectangle{{-1.5, -1.5}, {1.5, 1.5}};
    query.tolerance = 0.0006;
    query.features = true;
    query.technique = Technique::raster;
    scene.queries.emplace_back(query);
    return scene;
}

Scene instances() {
    Scene scene;
    Random random(3);
    const test::Rings big = test::coast(random, 20000, 0.5);
    const ShapeHandle coast = scene.add(big);
    const ShapeHandle star =
        scene.add(test::scaled_and_moved(test::star(random, 50, 0.4), 0.01, {}));
    for (std::size_t i = 0; i < 2000; ++i) {
        PenetrationQuery query;
        query.a = {star, {big[0][10 * i], random.between(0.0, 2.0 * std::numbers::pi)}};
        query.b = {coast, {}};
        query.tolerance = 0.0005;
        query.technique = Technique::raster;
        scene.queries.emplace_back(query);
    }
    return scene;
}

/// Time: of both.
void measure(State& state, const Scene& scene) {
    queries::QueryLimits limits;
    limits.memory = std::uint64_t{8} << 30U;
    device_input::Planner planner(limits);
    raster::PointPlanner points;
    const auto plan_drawn = [&](device_input::CurrentQuery& current, AnyResult& result) {
        points.plan(current, result);
    };
    raster::DrawnBatchBuilder builder(limits.subpixel);
    device_input::Plan plan;
    std::vector<raster::DrawnBatch> batches;
    std::vector<queries::QueryShapes> shapes;
    std::vector<AnyResult> results;
    run(state, [&]() -> Numbers {
        const double start = processor_milliseconds();
        queries::find_shapes(
            scene.queries,
            [&](ShapeHandle shape) {
                return shape.index < scene.shapes.size() ? &scene.shapes[shape.index] : nullptr;
            },
            shapes);
        test::plan_all(test::checked_queries(scene.queries, shapes, limits, results), plan_drawn,
                       planner, plan, results);
        const double planned = processor_milliseconds();
        std::size_t vertices = 0;
        const std::uint32_t tile_batches = builder.build(plan, batches);
        for (const raster::DrawnBatch& batch : std::span(batches).first(tile_batches)) {
            for (const geometry::Mesh& mesh : batch.meshes.meshes()) {
                vertices += mesh.size();
            }
            for (const std::vector<raster::TileVertex>& mesh : batch.meshes.tile_meshes()) {
                vertices += mesh.size();
            }
        }
        return {{"localize and plan ms", planned - start},
                {"build ms", processor_milliseconds() - planned},
                {"tiles", static_cast<double>(plan.tiles.size())},
                {"tile batches", tile_batches},
                {"mesh vertices", static_cast<double>(vertices)}};
    });
}

void add_scene(const std::string& name, Scene (*make)()) {
    add("plan/" + name, 5, [make](State& state) { measure(state, make()); });
}

const bool plans_are_added = [] {
    add_scene("10,000 pairs, vertices", [] { return pairs(PenetrationPoints::vertices); });
    add_scene("10,000 pairs, boundary points", [] { return pairs(PenetrationPoints::boundary); });
    add_scene("Iceland in Ireland, d = 0.005", [] { return outlines(NEARFIELD_TEST_DATA); });
    add_scene("field with features, coast of 20,000 vertices", field);
    add_scene("2,000 stars along a coast of 20,000 vertices", instances);
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
