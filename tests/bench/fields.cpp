// Measures distance fields, of 1024 x 1024 cells but for many small ones, by the techniques compute
// and cpu, and prints a table in Markdown, medians: what the calling thread does until the
// submission, in wall-clock time and in time of its processor; the device; the whole frame; and the
// processor time of all threads, a software driver's included, which depends less on other load.

#include <nearfield/nearfield.hpp>

#include <tests/bench/clocks.hpp>
#include <tests/bench/take.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace nearfield;
using bench::median;
using bench::processor_milliseconds;
using bench::require;
using bench::take;

constexpr int frames = 21;

struct Scene {
    std::string name;
    test::Rings rings;
    bool features = false;
    int points = 0;
    std::uint64_t small_fields = 0;
};

/// A field of 1024 x 1024 cells, or of a part of it at points.
DistanceFieldQuery large_field(Context& context, const Scene& scene,
                               const std::vector<Vector2>& points) {
    constexpr double cells = 1024.0;
    DistanceFieldQuery query;
    query.b = {take(context.add_shape(scene.rings)), {{0.01, -0.02}, 0.2}};
    query.rectangle = Rectangle{{-1.5, -1.5}, {1.5, 1.5}};
    query.tolerance = 3.0 / (cells - 0.5) / std::numbers::sqrt2;
    query.features = scene.features;
    query.points = points;
    query.values = points.empty();
    return query;
}

/// A field of 32 x 32 cells.
DistanceFieldQuery small_field(Context& context, std::uint64_t seed) {
    constexpr double cells = 32.0;
    test::Random random(seed);
    DistanceFieldQuery query;
    query.b = {take(context.add_shape(test::star(random, 50, 0.4))), {{}, 0.2}};
    query.rectangle = Rectangle{{-1.1, -1.1}, {1.1, 1.1}};
    query.tolerance = 2.2 / (cells - 0.5) / std::numbers::sqrt2;
    return query;
}

void measure(Context& context, const Scene& scene, Technique technique, bool passes) {
    std::vector<Vector2> points;
    test::Random random(4);
    for (int i = 0; i < scene.points; ++i) {
        points.push_back({random.between(-1.4, 1.4), random.between(-1.4, 1.4)});
    }
    Batch batch;
    const auto add = [&](DistanceFieldQuery query) {
        query.technique = technique;
        batch.add(query);
    };
    for (std::uint64_t i = 0; i < scene.small_fields; ++i) {
        add(small_field(context, i));
    }
    if (scene.small_fields == 0) {
        add(large_field(context, scene, points));
    }
    Results results;
    std::vector<double> submitted, processor, device, whole, all;
    std::map<std::string, std::vector<double>> by_pass;
    for (int frame = 0; frame < frames + 2; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        const auto since_start = [&] {
            return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() -
                                                             start)
                .count();
        };
        const double processor_start = processor_milliseconds(CLOCK_THREAD_CPUTIME_ID);
        const double all_start = processor_milliseconds(CLOCK_PROCESS_CPUTIME_ID);
        const Ticket ticket = take(context.submit(batch));
        const double until_submitted = since_start();
        const double processor_end = processor_milliseconds(CLOCK_THREAD_CPUTIME_ID);
        require(context.collect(ticket, results));
        if (frame >= 2) {
            submitted.push_back(until_submitted);
            processor.push_back(processor_end - processor_start);
            device.push_back(results.timings.device);
            whole.push_back(since_start());
            all.push_back(processor_milliseconds(CLOCK_PROCESS_CPUTIME_ID) - all_start);
            for (const PassTime& pass : results.timings.passes) {
                by_pass[pass.name].push_back(pass.milliseconds);
            }
        }
    }
    std::printf("| %s | %s | %.3f | %.3f | %.1f | %.1f | %.1f |\n", scene.name.c_str(),
                to_string(technique), median(submitted), median(processor), median(device),
                median(whole), median(all));
    if (passes) {
        for (const auto& [name, times] : by_pass) {
            std::printf("|   %s | | | | %.2f | | |\n", name.c_str(), median(times));
        }
    }
    std::fflush(stdout);
}

}  // namespace

/// With --passes also the times of the device's passes.
int main(int argc, char** argv) {
    try {
        const bool passes = argc > 1 && std::strcmp(argv[1], "--passes") == 0;
        Settings settings;
        settings.timestamps = passes;
        test::Random random(2);
        const std::vector<Scene> scenes{
            {"coast, 8,000 vertices", test::coast(random, 8000, 0.5)},
            {"the same with features", test::coast(random, 8000, 0.5), true},
            {"1,000 points of it", test::coast(random, 8000, 0.5), false, 1000},
            {"star, 50 vertices", test::star(random, 50, 0.4)},
            {"1,000 stars, 32 x 32 cells each", {}, false, 0, 1000},
            {"coast, 100,000 vertices", test::coast(random, 100000, 0.5)},
        };
        std::puts(
            "| field | technique | to the submission, ms | of it processor | device | whole | "
            "processor time of all threads |\n"
            "|---|---|---|---|---|---|---|");
        for (const Scene& scene : scenes) {
            Context context = take(Context::create_headless({}, settings));
            measure(context, scene, Technique::compute, passes);
            measure(context, scene, Technique::cpu, passes);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
