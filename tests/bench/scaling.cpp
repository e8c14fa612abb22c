// Measures how the time of a frame grows with the number of edges for the technique cpu, as a table
// in Markdown: simple shapes, and shapes for which many data structures degenerate to brute force.
// Both shapes are submitted anew each frame. The last column is the exponent from the second size
// to the third; 1 means linear growth. A second table has families that are awkward for boxes, by
// every technique.

#include <nearfield/nearfield.hpp>

#include <tests/bench/awkward_families.hpp>
#include <tests/bench/take.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nearfield::bench::require;
using nearfield::bench::take;

using namespace nearfield;
using test::Random;
using test::Rings;

constexpr std::array<int, 3> sizes{2000, 8000, 32000};
constexpr int frames = 5;
// Shapes are about 20 across.
constexpr double tolerance = 0.05;

/// Teeth of length 5, which become thinner as their number grows; consecutive edges are `step`
/// apart.
Rings comb(int edges) {
    const int teeth = edges / 4;
    const double step = 20.0 / teeth;
    Ring ring{{-10.0, -3.0}, {10.0, -3.0}};
    for (int i = teeth - 1; i >= 0; --i) {
        const double x = i * step - 10.0;
        ring.insert(
            ring.end(),
            {{x + 0.7 * step, -2.0}, {x + 0.6 * step, 3.0}, {x + 0.1 * step, 3.0}, {x, -2.0}});
    }
    return {ring};
}

Rings saw(int edges) {
    const int teeth = edges / 2;
    Ring ring{{-10.0, -5.0}, {10.0, -5.0}};
    for (int i = teeth - 1; i >= 0; --i) {
        const double x = 20.0 * i / teeth - 10.0;
        ring.insert(ring.end(), {{x + 10.0 / teeth, 0.3}, {x, 0.0}});
    }
    return {ring};
}

Ring square(double x, double y, double side) {
    return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

/// Squares at random positions, which cover a quarter of the area.
Rings islands(int edges) {
    Random random(3);
    const double side = 10.0 / std::sqrt(edges / 4);
    Rings rings;
    for (int i = 0; i < edges / 4; ++i) {
        rings.push_back(square(random.between(-10.0, 10.0), random.between(-10.0, 10.0), side));
    }
    return rings;
}

Rings plate_with_holes(int edges) {
    const int across = static_cast<int>(std::sqrt(edges / 4));
    const double step = 20.0 / across;
    Rings rings{square(-10.0, -10.0, 20.0)};
    for (int i = 0; i < across * across; ++i) {
        const int row = i / across;
        rings.push_back(
            square(step * (i % across + 0.25) - 10.0, step * (row + 0.25) - 10.0, 0.5 * step));
    }
    return rings;
}

Rings grown(Rings rings, double by) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {by * vertex.x, by * vertex.y};
        }
    }
    return rings;
}

Rings smooth(int edges) {
    Random random(5);
    return grown(test::star(random, edges, 0.999999), 10.0);
}

Rings coast(int edges) {
    Random random(7);
    return grown(test::coast(random, edges, 0.3), 8.0);
}

struct Family {
    const char* name;
    Rings (*make)(int edges);
    Pose pose;  // of the second shape, so that the two overlap
};

struct Question {
    const char* name;
    std::function<void(Batch&, const Instance& a, const Instance& b)> add;
};

std::vector<Question> questions() {
    const auto penetration = [](PenetrationPoints points, bool records) {
        return [points, records](Batch& batch, const Instance& a, const Instance& b) {
            PenetrationQuery query{a, b, tolerance};
            query.points = points;
            query.summary_only = !records;
            query.technique = Technique::cpu;
            batch.add(query);
        };
    };
    return {{"vertices, no records", penetration(PenetrationPoints::vertices, false)},
            {"vertices", penetration(PenetrationPoints::vertices, true)},
            {"boundary samples", penetration(PenetrationPoints::boundary, true)},
            {"contacts",
             [](Batch& batch, const Instance& a, const Instance& b) {
                 ContactQuery query{a, b, tolerance};
                 query.contact_distance = 2.0 * tolerance;
                 query.technique = Technique::cpu;
                 batch.add(query);
             }},
            {"separation",
             [](Batch& batch, const Instance& a, const Instance& b) {
                 Instance apart = b;
                 apart.pose.translation.y += 30.0;
                 batch.add(SeparationQuery{a, apart, tolerance, Technique::cpu});
             }},
            {"field with features", [](Batch& batch, const Instance& a, const Instance& b) {
                 DistanceFieldQuery query{a, b, tolerance};
                 query.rectangle = Rectangle{{-12.0, -12.0}, {12.0, 12.0}};
                 query.features = true;
                 query.technique = Technique::cpu;
                 batch.add(query);
             }}};
}

/// The minimum over a few frames.
double measure(Context& context, const Rings& rings, const Pose& pose, const Question& question) {
    using Clock = std::chrono::steady_clock;
    const ShapeHandle a = take(context.add_shape(rings));
    const ShapeHandle b = take(context.add_shape(rings));
    Batch batch;
    Results results;
    double least = INFINITY;
    for (int i = 0; i < frames; ++i) {
        const Clock::time_point start = Clock::now();
        require(context.update_shape(a, rings));
        require(context.update_shape(b, rings));
        batch.clear();
        question.add(batch, {a, {}}, {b, pose});
        require(context.run(batch, results));
        least = std::min(least,
                         std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    std::visit([](const auto& result) { require(result.status); }, results.results.front());
    require(context.remove_shape(a));
    require(context.remove_shape(b));
    return least;
}

}  // namespace

int main() {
    try {
        Context context = take(Context::create_headless());
        const double half_tooth = 0.25 * 20.0 / (sizes.back() / 4);
        const std::array families{Family{"comb in a comb", comb, {{half_tooth, 4.9}, 0.0}},
                                  Family{"saw on a saw", saw, {{0.01, 0.2}, 3.14159265358979}},
                                  Family{"islands in any order", islands, {{0.4, 4.1}, 0.3}},
                                  Family{"plate with holes", plate_with_holes, {{0.4, 4.1}, 0.3}},
                                  Family{"smooth", smooth, {{0.4, 4.1}, 0.3}},
                                  Family{"coast", coast, {{0.4, 4.1}, 0.3}}};
        std::printf("| shapes | question |");
        for (const int size : sizes) {
            std::printf(" %d edges, ms |", size);
        }
        std::printf(" exponent |\n|---|---|---|---|---|---|\n");
        for (const Family& family : families) {
            for (const Question& question : questions()) {
                std::array<double, sizes.size()> times{};
                std::transform(sizes.begin(), sizes.end(), times.begin(), [&](int size) {
                    return measure(context, family.make(size), family.pose, question);
                });
                std::printf("| %s | %s | %.3g | %.3g | %.3g | %.1f |\n", family.name, question.name,
                            times[0], times[1], times[2],
                            std::log(times[2] / times[1]) /
                                std::log(static_cast<double>(sizes[2]) / sizes[1]));
                std::fflush(stdout);
            }
        }
        bench::print_awkward_families(context);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_scaling: %s\n", error.what());
        return 1;
    }
}
