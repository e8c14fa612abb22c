// Measures the times of separation vectors and the tightness of their bounds, as a table in
// Markdown: the objects of the paper's scenes, random intersecting pairs of several families, and
// the outlines of a folder, each against the next.

#include <nearfield/nearfield.hpp>

#include <tests/bench/take.hpp>
#include <tests/support/outlines.hpp>
#include <tools/benchmark/workloads.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nearfield::bench::take;

using namespace nearfield;
using test::Random;
using test::Rings;

constexpr int pairs = 20;
constexpr int repetitions = 5;

struct Measured {
    double milliseconds = 0.0;
    double ratio = 1.0;  // lower bound divided by length
};

double processor_milliseconds() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The minimum of some runs; shapes that do not intersect are skipped.
void measure(Context& context, const Rings& a, const Rings& b, const Pose& pose_a,
             const Pose& pose_b, double tolerance, std::vector<Measured>& all) {
    const ShapeHandle shape_a = take(context.add_shape(a));
    const ShapeHandle shape_b = take(context.add_shape(b));
    Batch batch;
    const auto handle =
        batch.add(SeparationVectorQuery{{shape_a, pose_a}, {shape_b, pose_b}, tolerance});
    Results results;
    Measured measured{INFINITY, 1.0};
    for (int i = 0; i < repetitions; ++i) {
        const double start = processor_milliseconds();
        if (const Status status = context.run(batch, results); !status.ok()) {
            throw std::runtime_error(status.text());
        }
        measured.milliseconds = std::min(measured.milliseconds, processor_milliseconds() - start);
    }
    const SeparationVectorResult& result = results[handle];
    if (!result.status.ok()) {
        throw std::runtime_error(result.status.text());
    }
    if (result.intersects) {
        // Shapes that touch have a length of a few roundings, and no bound.
        measured.ratio = result.length > tolerance ? result.lower_bound / result.length : 1.0;
        all.push_back(measured);
    }
    static_cast<void>(context.remove_shape(shape_a));
    static_cast<void>(context.remove_shape(shape_b));
}

void print(const std::string& name, std::vector<Measured> all) {
    if (all.empty()) {
        throw std::runtime_error(name + ": none intersects");
    }
    const auto at = [&all](double part, auto member) {
        std::sort(all.begin(), all.end(),
                  [member](const Measured& i, const Measured& j) { return i.*member < j.*member; });
        return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1) + 0.5)].*
               member;
    };
    std::printf("| %s | %.2f | %.2f | %.3f | %.3f | %.3f |\n", name.c_str(),
                at(0.5, &Measured::milliseconds), at(1.0, &Measured::milliseconds),
                at(0.5, &Measured::ratio), at(0.1, &Measured::ratio), at(0.0, &Measured::ratio));
    std::fflush(stdout);
}

struct Family {
    std::string name;
    std::function<Rings(Random&)> make;
    bool turned = true;
};

std::vector<Family> families() {
    std::vector<Family> all;
    for (const int n : {10, 50, 200, 1000}) {
        all.push_back({"stars, " + std::to_string(n) + " edges",
                       [n](Random& random) { return test::star(random, n, 0.5); }});
        all.push_back({"coast lines, " + std::to_string(n) + " edges",
                       [n](Random& random) { return test::coast(random, n, 0.3); }});
    }
    all.push_back({"stars with holes", [](Random& random) { return test::with_holes(random, 3); }});
    for (const int teeth : {5, 20, 100}) {
        const auto make = [teeth](Random&) { return test::comb(teeth); };
        all.push_back({"combs, " + std::to_string(teeth) + " teeth, interlocked", make, false});
        all.push_back({"combs, " + std::to_string(teeth) + " teeth, turned", make});
    }
    all.push_back({"spirals", [](Random&) { return test::spiral(3.0, 0.1, 100); }});
    return all;
}

void measure_families(Context& context) {
    for (const Family& family : families()) {
        Random random(20);
        std::vector<Measured> all;
        for (int i = 0; i < pairs; ++i) {
            const Rings a = family.make(random);
            const Rings b = family.make(random);
            const Pose pose{
                {random.between(-0.7, 0.7), random.between(-0.7, 0.7)},
                family.turned ? random.between(-3.0, 3.0) : (i % 2 == 0 ? 0.0 : std::numbers::pi)};
            measure(context, a, b, pose, {}, 1e-3, all);
        }
        print(family.name, all);
    }
}

/// The objects of a scene: the pairs that intersect where they are, and each with the next one,
/// moved to random poses.
void measure_scene(Context& context, const std::string& name, const tools::Scene& scene) {
    constexpr double tolerance = 1e-3;
    const auto rings_of = [&scene](std::size_t instance) -> const Rings& {
        return scene.shapes[scene.instances[instance].shape].rings;
    };
    std::vector<Measured> in_place;
    std::vector<Measured> anywhere;
    Random random(20);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        for (std::size_t k = i + 1; k < scene.instances.size(); ++k) {
            measure(context, rings_of(i), rings_of(k), scene.instances[i].pose,
                    scene.instances[k].pose, tolerance, in_place);
        }
        const double x = random.between(-0.7, 0.7);
        const double y = random.between(-0.7, 0.7);
        measure(context, rings_of(i), rings_of((i + 1) % scene.instances.size()),
                {{x, y}, random.between(-3.0, 3.0)}, {}, tolerance, anywhere);
    }
    print(name + " of the paper", in_place);
    print(name + ", moved into each other", anywhere);
}

void measure_paper_scenes(Context& context) {
    measure_scene(context, "map", benchmark::map_scene(1));
    measure_scene(context, "gears", benchmark::gears_scene(1));
    measure_scene(context, "links", benchmark::links_scene(1));
    measure_scene(context, "cars", benchmark::cars_scene(1));
    measure_scene(context, "wavy bars", benchmark::wavy_scene(1));
}

/// Moved so that the centres of the boxes coincide.
void measure_outlines(Context& context, const std::string& folder) {
    const std::vector<test::NamedRings> outlines = test::read_outlines(folder);
    const auto box_of = [](const Rings& rings) {
        Rectangle box{rings[0][0], rings[0][0]};
        for (const Ring& ring : rings) {
            for (const Vector2& vertex : ring) {
                box.min = {std::min(box.min.x, vertex.x), std::min(box.min.y, vertex.y)};
                box.max = {std::max(box.max.x, vertex.x), std::max(box.max.y, vertex.y)};
            }
        }
        return box;
    };
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const test::NamedRings& a = outlines[i];
        const test::NamedRings& b = outlines[(i + 1) % outlines.size()];
        const Rectangle box_a = box_of(a.rings);
        const Rectangle box_b = box_of(b.rings);
        const Pose pose{{0.5 * (box_b.min.x + box_b.max.x - box_a.min.x - box_a.max.x),
                         0.5 * (box_b.min.y + box_b.max.y - box_a.min.y - box_a.max.y)},
                        0.0};
        std::vector<Measured> all;
        measure(context, a.rings, b.rings, pose, {}, 1e-3 * (box_a.max.x - box_a.min.x), all);
        const auto edges = [](const Rings& rings) {
            std::size_t count = 0;
            for (const Ring& ring : rings) {
                count += ring.size();
            }
            return std::to_string(count);
        };
        print(a.name + " (" + edges(a.rings) + ") out of " + b.name + " (" + edges(b.rings) + ")",
              all);
    }
}

}  // namespace

int main(int count, char** words) {
    try {
        Context context = take(Context::create_headless());
        std::puts("| | ms, median | ms, most | bound to length, median | worst tenth | worst |");
        std::puts("|---|---|---|---|---|---|");
        measure_paper_scenes(context);
        measure_families(context);
        measure_outlines(context, count > 1 ? words[1] : NEARFIELD_TEST_DATA);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_separation_vectors: %s\n", error.what());
        return 1;
    }
}
