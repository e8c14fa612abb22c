// How the time of a frame grows with the number of edges: for the technique cpu simple shapes, and
// shapes for which many data structures degenerate to brute force, both submitted anew each frame;
// and families that are awkward for boxes, by every technique. The fit ("BigO") says how it grows.

#include <nearfield/nearfield.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::bench {
namespace {

using test::Random;
using test::Rings;

constexpr std::int64_t largest = 32000;
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

/// Two instances of one shape, whose vertices are passed anew each frame. `add_query(a, b, batch)`.
template <class AddQuery>
void measure(State& state, const Rings& rings, const AddQuery& add_query) {
    Context context = take(Context::create_headless());
    const ShapeHandle a = take(context.add_shape(rings));
    const ShapeHandle b = take(context.add_shape(rings));
    Batch batch;
    Results results;
    run(state, [&]() -> Numbers {
        require(context.update_shape(a, rings));
        require(context.update_shape(b, rings));
        batch.clear();
        add_query(batch, a, b);
        require(context.run(batch, results));
        double count = 0.0;
        std::visit(
            [&](const auto& result) {
                require(result.status);
                if constexpr (requires { result.count; }) {
                    count = static_cast<double>(result.count);
                }
            },
            results.results.front());
        return {{"answers", count}};
    });
    state.SetComplexityN(state.range(0));
}

/// `pose`: of the second shape, so that the two overlap.
void add_family(const std::string& name, Rings (*make)(int edges), const Pose& pose) {
    for (const Question& question : questions()) {
        add("scaling/" + name + ", " + question.name, 5,
            [=](State& state) {
                measure(state, make(static_cast<int>(state.range(0))),
                        [&](Batch& batch, ShapeHandle a, ShapeHandle b) {
                            question.add(batch, {a, {}}, {b, pose});
                        });
            })
            ->Arg(2000)
            ->Arg(8000)
            ->Arg(largest)
            ->Complexity();
    }
}

// Awkward shapes are 2 across.
constexpr double fine = 0.02;

Ring regular_ring(int vertices, double (*radius)(int vertex), double scale) {
    Ring ring;
    for (int i = 0; i < vertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / vertices;
        ring.push_back({scale * radius(i) * std::cos(angle), scale * radius(i) * std::sin(angle)});
    }
    return ring;
}

Rings nested_pentagons(int rings) {
    Rings all;
    for (int i = 0; i < rings; ++i) {
        all.push_back(regular_ring(
            5, [](int) { return 1.0; }, 1.0 - static_cast<double>(i) / rings));
    }
    return all;
}

Rings star_of_spikes(int spikes) {
    return {regular_ring(
        2 * spikes, [](int i) { return i % 2 == 0 ? 1.0 : 0.5; }, 1.0)};
}

void add_query(bool contacts, Technique technique, const Instance& a, const Instance& b,
               Batch& batch) {
    if (contacts) {
        ContactQuery query{a, b, fine};
        query.contact_distance = 2.0 * fine;
        query.summary_only = true;
        query.technique = technique;
        batch.add(query);
    } else {
        PenetrationQuery query{a, b, fine};
        query.summary_only = true;
        query.technique = technique;
        batch.add(query);
    }
}

/// CPU: of all threads, those of a software device included.
void add_awkward(const std::string& name, Rings (*make)(int size),
                 const std::vector<std::int64_t>& sizes, const std::vector<Technique>& techniques,
                 const Pose& pose) {
    for (const bool contacts : {true, false}) {
        for (const Technique technique : techniques) {
            auto* const added =
                add("awkward/" + name + (contacts ? ", contacts/" : ", penetration/") +
                        to_string(technique),
                    2, [=](State& state) {
                        measure(state, make(static_cast<int>(state.range(0))),
                                [&](Batch& batch, ShapeHandle a, ShapeHandle b) {
                                    add_query(contacts, technique, {a, {}}, {b, pose}, batch);
                                });
                    });
            for (const std::int64_t size : sizes) {
                added->Arg(size);
            }
            added->MeasureProcessCPUTime()->Complexity();
        }
    }
}

const bool sizes_are_added = [] {
    const double half_tooth = 0.25 * 20.0 / (largest / 4);
    add_family("comb in a comb", comb, {{half_tooth, 4.9}, 0.0});
    add_family("saw on a saw", saw, {{0.01, 0.2}, std::numbers::pi});
    add_family("islands in any order", islands, {{0.4, 4.1}, 0.3});
    add_family("plate with holes", plate_with_holes, {{0.4, 4.1}, 0.3});
    add_family("smooth", smooth, {{0.4, 4.1}, 0.3});
    add_family("coast", coast, {{0.4, 4.1}, 0.3});
    add_awkward("nested pentagons with themselves (rings)", nested_pentagons,
                {250, 500, 1000, 2000}, {Technique::cpu, Technique::compute, Technique::raster},
                {});
    add_awkward("two stars that overlap (spikes of each)", star_of_spikes, {5000, 10000, 20000},
                {Technique::cpu}, {{0.3, 0.2}, 0.0});
    add_awkward("two stars that overlap (spikes of each)", star_of_spikes, {1250, 2500, 5000},
                {Technique::compute, Technique::raster}, {{0.3, 0.2}, 0.0});
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
