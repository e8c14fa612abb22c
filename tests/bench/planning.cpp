// Measures the CPU time for planning a batch and building its tile batches, without a device, and
// prints a table in Markdown: many pairs, a tolerance that gives thousands of tiles, a large field,
// a large shape in many queries.

#include <engine/plan/planner.hpp>
#include <engine/raster/drawn_batch_builder.hpp>
#include <engine/raster/point_planner.hpp>

#include <tests/support/checked_queries.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <deque>
#include <filesystem>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace nearfield;
using test::Random;

/// The time of this thread only, because other load must not count.
double processor_milliseconds() {
    timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) {
        throw std::runtime_error("no processor time");
    }
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Scene {
    std::string name;
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
    Scene scene{points == PenetrationPoints::vertices ? "10,000 pairs, vertices"
                                                      : "10,000 pairs, boundary points",
                {},
                {}};
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
    Scene scene{"Iceland in Ireland, d = 0.005", {}, {}};
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
    Scene scene{"field with features, coast of 20,000 vertices", {}, {}};
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
    Scene scene{"2,000 stars along a coast of 20,000 vertices", {}, {}};
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

void measure(const Scene& scene, int frames) {
    plan::PlanLimits limits;
    limits.memory = std::uint64_t{8} << 30U;
    plan::Planner planner(limits);
    raster::PointPlanner points;
    const auto plan_drawn = [&](plan::CurrentQuery& current, AnyResult& result) {
        points.plan(current, result);
    };
    raster::DrawnBatchBuilder builder(limits.subpixel);
    plan::Plan plan;
    std::vector<raster::DrawnBatch> batches;
    std::uint32_t tile_batches = 0;
    std::vector<plan::QueryShapes> shapes;
    std::vector<AnyResult> results;
    double planned = HUGE_VAL;
    double built = HUGE_VAL;
    std::size_t vertices = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const double start = processor_milliseconds();
        plan::find_shapes(
            scene.queries,
            [&](ShapeHandle shape) {
                return shape.index < scene.shapes.size() ? &scene.shapes[shape.index] : nullptr;
            },
            shapes);
        test::plan_all(test::checked_queries(scene.queries, shapes, limits, results), plan_drawn,
                       planner, plan, results);
        const double middle = processor_milliseconds();
        vertices = 0;
        tile_batches = builder.build(plan, batches);
        for (const raster::DrawnBatch& batch : std::span(batches).first(tile_batches)) {
            for (const geometry::Mesh& mesh : batch.meshes.meshes()) {
                vertices += mesh.size();
            }
            for (const std::vector<raster::TileVertex>& mesh : batch.meshes.tile_meshes()) {
                vertices += mesh.size();
            }
        }
        planned = std::min(planned, middle - start);
        built = std::min(built, processor_milliseconds() - middle);
    }
    std::printf("| %s | %zu | %u | %zu | %.1f | %.1f |\n", scene.name.c_str(), plan.tiles.size(),
                tile_batches, vertices, planned, built);
    std::fflush(stdout);
}

}  // namespace

int main() {
    try {
        std::puts(
            "| scene | tiles | tile batches | mesh vertices | localise and plan, ms | build, ms |\n"
            "|---|---|---|---|---|---|");
        measure(pairs(PenetrationPoints::vertices), 5);
        measure(pairs(PenetrationPoints::boundary), 5);
        measure(outlines(NEARFIELD_TEST_DATA), 5);
        measure(field(), 5);
        measure(instances(), 5);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
