// Measures the effect of the hierarchies' height and bounding volumes on a whole penetration query
// and prints a table in Markdown: two outlines whose boxes overlap by part of their width, at rest
// or deformed by a wave of their vertices in every frame.

#include <nearfield/nearfield.hpp>

#include <tests/bench/take.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nearfield::bench::require;
using nearfield::bench::take;

using nearfield::BoundingVolume;
using nearfield::Ring;
using nearfield::Vector2;

constexpr int warm_up = 3;
constexpr int frames = 60;

struct Extent {
    double low = INFINITY;
    double high = -INFINITY;
};

Extent width_of(const std::vector<Ring>& rings) {
    Extent extent;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            extent.low = std::min(extent.low, vertex.x);
            extent.high = std::max(extent.high, vertex.x);
        }
    }
    return extent;
}

std::vector<Ring> waved(std::vector<Ring> rings, double amplitude, int frame) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex.y += amplitude * std::sin(vertex.x / (6.0 * amplitude) + 0.3 * frame);
        }
    }
    return rings;
}

struct Scene {
    std::string name;
    std::vector<Ring> a;
    std::vector<Ring> b;
    double overlap = 0.0;  // fraction of the boxes' widths
    bool deforming = false;
};

struct Times {
    double localize = 0.0;
    double rest = 0.0;
    nearfield::LocalizationStatistics statistics;
};

/// The lower quartile: on a shared machine the faster frames are the meaningful ones.
double lower_quartile(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + frames / 4, values.end());
    return values[frames / 4];
}

Times measure(nearfield::Context& context, const Scene& scene) {
    const Extent a = width_of(scene.a);
    const Extent b = width_of(scene.b);
    const double shared = scene.overlap * std::min(a.high - a.low, b.high - b.low);
    nearfield::PenetrationQuery query;
    query.technique = nearfield::Technique::raster;
    query.a = {take(context.add_shape(scene.a)), {}};
    query.b = {take(context.add_shape(scene.b)), {{a.high - shared - b.low, 0.0}, 0.0}};
    query.tolerance = (a.high - a.low) / 500.0;
    std::vector<double> localize;
    std::vector<double> rest;
    nearfield::Results results;
    nearfield::Batch batch;
    for (int frame = -warm_up; frame < frames; ++frame) {
        if (scene.deforming) {
            const double amplitude = 5.0 * query.tolerance;
            require(context.update_shape(query.a.shape, waved(scene.a, amplitude, frame)));
            require(context.update_shape(query.b.shape, waved(scene.b, amplitude, frame)));
        }
        batch.clear();
        const auto handle = batch.add(query);
        require(context.run(batch, results));
        require(results[handle].status);
        if (frame >= 0) {
            localize.push_back(results.timings.localize);
            rest.push_back(results.timings.total - results.timings.localize);
        }
    }
    const Times times{lower_quartile(localize), lower_quartile(rest),
                      std::get<nearfield::PenetrationResult>(results.results.front()).localization};
    require(context.remove_shape(query.a.shape));
    require(context.remove_shape(query.b.shape));
    return times;
}

std::vector<Scene> all_scenes() {
    const std::filesystem::path data(NEARFIELD_TEST_DATA);
    const std::vector<Ring> a = nearfield::test::read_outline(data / "iceland_10m.geojson").rings;
    const std::vector<Ring> b = nearfield::test::read_outline(data / "ireland_10m.geojson").rings;
    std::vector<Scene> scenes;
    for (const double overlap : {0.01, 0.1, 0.5}) {
        for (const bool deforming : {false, true}) {
            scenes.push_back({std::to_string(static_cast<int>(100.0 * overlap)) + " % " +
                                  (deforming ? "deforming" : "rigid"),
                              a, b, overlap, deforming});
        }
    }
    return scenes;
}

nearfield::Context create_context(BoundingVolume volume, std::uint32_t height) {
    nearfield::Settings settings;
    settings.bounding_volume = volume;
    settings.hierarchy_height = height;
    return take(nearfield::Context::create_headless({}, settings));
}

void run() {
    const std::vector<Scene> scenes = all_scenes();
    std::printf(
        "| scene | boxes | height | localize, ms | rest of the frame, ms | nodes | pairs "
        "rejected | edges kept |\n|---|---|---|---|---|---|---|---|\n");
    for (const std::uint32_t height : {0U, 2U, 4U, 6U, 8U, 10U, 12U, 16U}) {
        std::array<nearfield::Context, 2> contexts{
            create_context(BoundingVolume::axis_aligned, height),
            create_context(BoundingVolume::oriented, height)};
        for (const Scene& scene : scenes) {
            // Alternating, so that both are measured under the same load.
            for (const BoundingVolume volume :
                 {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
                const bool oriented = volume == BoundingVolume::oriented;
                const Times times = measure(contexts[oriented ? 1 : 0], scene);
                std::printf("| %s | %s | %u | %.3f | %.2f | %llu | %llu | %llu |\n",
                            scene.name.c_str(), oriented ? "oriented" : "axis-aligned", height,
                            times.localize, times.rest,
                            static_cast<unsigned long long>(times.statistics.nodes_evaluated),
                            static_cast<unsigned long long>(times.statistics.pairs_rejected),
                            static_cast<unsigned long long>(times.statistics.edges_kept));
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace

int main() {
    try {
        run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_localization: %s\n", error.what());
        return 1;
    }
    return 0;
}
