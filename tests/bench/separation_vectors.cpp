// Separation vectors: their times, and how tight their bounds are, for the objects of the paper's
// scenes, random intersecting pairs of several families, and outlines, each against the next.

#include <nearfield/nearfield.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/outlines.hpp>
#include <tools/benchmark/workloads.hpp>

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::bench {
namespace {

using test::Random;
using test::Rings;

/// Two shapes, the first at a pose, the second where it is.
struct Pair {
    Rings a;
    Rings b;
    Pose pose_a = {};
    Pose pose_b = {};
    double tolerance = 1e-3;
};

/// The number at a part of the way through a list in ascending order.
double at(std::vector<double> numbers, double part) {
    std::sort(numbers.begin(), numbers.end());
    return numbers[static_cast<std::size_t>(part * static_cast<double>(numbers.size() - 1) + 0.5)];
}

/// A frame asks about each pair that intersects. `bound`: the lower bound divided by the length.
void measure(State& state, const std::vector<Pair>& pairs) {
    Context context = take(Context::create_cpu());
    std::vector<Batch> batches;
    Results results;
    for (const Pair& pair : pairs) {
        Batch batch;
        batch.add(SeparationVectorQuery{{take(context.add_shape(pair.a)), pair.pose_a},
                                        {take(context.add_shape(pair.b)), pair.pose_b},
                                        pair.tolerance});
        require(context.run(batch, results));
        if (std::get<SeparationVectorResult>(results.results.front()).intersects) {
            batches.push_back(std::move(batch));
        }
    }
    if (batches.empty()) {
        throw std::runtime_error("none intersects");
    }
    run(state, [&]() -> Numbers {
        std::vector<double> times;
        std::vector<double> bounds;
        for (const Batch& batch : batches) {
            const double start = processor_milliseconds();
            require(context.run(batch, results));
            times.push_back(processor_milliseconds() - start);
            const auto& result = std::get<SeparationVectorResult>(results.results.front());
            require(result.status);
            // Shapes that touch have a length of a few roundings, and no bound.
            bounds.push_back(result.length > result.tolerance ? result.lower_bound / result.length
                                                              : 1.0);
        }
        return {{"pairs", static_cast<double>(batches.size())},
                {"median ms", at(times, 0.5)},
                {"most ms", at(times, 1.0)},
                {"bound, median", at(bounds, 0.5)},
                {"bound, worst tenth", at(bounds, 0.1)},
                {"bound, worst", at(bounds, 0.0)}};
    });
}

/// `make()` makes the pairs.
template <class Make>
void add_pairs(const std::string& name, Make make) {
    add("separation vectors/" + name, 5, [make](State& state) { measure(state, make()); });
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

std::vector<Pair> pairs_of(const Family& family) {
    constexpr int count = 20;
    Random random(20);
    std::vector<Pair> pairs;
    for (int i = 0; i < count; ++i) {
        const Rings a = family.make(random);
        const Rings b = family.make(random);
        const double x = random.between(-0.7, 0.7);
        const double y = random.between(-0.7, 0.7);
        pairs.push_back(
            {a,
             b,
             {{x, y},
              family.turned ? random.between(-3.0, 3.0) : (i % 2 == 0 ? 0.0 : std::numbers::pi)}});
    }
    return pairs;
}

const Rings& rings_of(const tools::Scene& scene, std::size_t instance) {
    return scene.shapes[scene.instances[instance].shape].rings;
}

/// The pairs of a scene's objects where they are.
std::vector<Pair> pairs_in_place(const tools::Scene& scene) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        for (std::size_t k = i + 1; k < scene.instances.size(); ++k) {
            pairs.push_back({rings_of(scene, i), rings_of(scene, k), scene.instances[i].pose,
                             scene.instances[k].pose});
        }
    }
    return pairs;
}

/// Each object and the next, moved into each other.
std::vector<Pair> pairs_anywhere(const tools::Scene& scene) {
    std::vector<Pair> pairs;
    Random random(20);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const double x = random.between(-0.7, 0.7);
        const double y = random.between(-0.7, 0.7);
        pairs.push_back({rings_of(scene, i),
                         rings_of(scene, (i + 1) % scene.instances.size()),
                         {{x, y}, random.between(-3.0, 3.0)}});
    }
    return pairs;
}

/// An outline out of another, moved so that the centres of the boxes coincide.
Pair pair_of(const Rings& a, const Rings& b) {
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
    const Rectangle box_a = box_of(a);
    const Rectangle box_b = box_of(b);
    return {a,
            b,
            {{0.5 * (box_b.min.x + box_b.max.x - box_a.min.x - box_a.max.x),
              0.5 * (box_b.min.y + box_b.max.y - box_a.min.y - box_a.max.y)},
             0.0},
            {},
            1e-3 * (box_a.max.x - box_a.min.x)};
}

const bool vectors_are_added = [] {
    struct PaperScene {
        const char* name;
        tools::Scene (*make)(std::size_t scale);
    };
    for (const PaperScene& scene :
         {PaperScene{"map", benchmark::map_scene}, PaperScene{"gears", benchmark::gears_scene},
          PaperScene{"links", benchmark::links_scene}, PaperScene{"cars", benchmark::cars_scene},
          PaperScene{"wavy bars", benchmark::wavy_scene}}) {
        const std::string name = scene.name;
        add_pairs(name + " of the paper", [=] { return pairs_in_place(scene.make(1)); });
        add_pairs(name + ", moved into each other", [=] { return pairs_anywhere(scene.make(1)); });
    }
    for (const Family& family : families()) {
        add_pairs(family.name, [=] { return pairs_of(family); });
    }
    const std::vector<test::NamedRings> outlines = test::read_outlines(NEARFIELD_TEST_DATA);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const test::NamedRings& a = outlines[i];
        const test::NamedRings& b = outlines[(i + 1) % outlines.size()];
        add_pairs(a.name + " out of " + b.name,
                  [=] { return std::vector<Pair>{pair_of(a.rings, b.rings)}; });
    }
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
