// What resolve_fill() costs: outlines of 10,000 edges, and random chords, which cross everywhere.

#include <nearfield/fill.hpp>

#include <tests/bench/bench.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace nearfield::bench {
namespace {

Ring wavy(double x, double y, double radius, int vertices) {
    Ring ring;
    for (int i = 0; i < vertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / vertices;
        const double at = radius * (1.0 + 0.1 * std::sin(37.0 * angle));
        ring.push_back({x + at * std::cos(angle), y + at * std::sin(angle)});
    }
    return ring;
}

Ring rectangle(double x, double y, double width, double height) {
    return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

std::size_t size_of(const std::vector<Ring>& rings) {
    std::size_t size = 0;
    for (const Ring& ring : rings) {
        size += ring.size();
    }
    return size;
}

void add_input(const std::string& name, const std::vector<Ring>& rings, FillRule rule) {
    add("fill/" + name, 25, [=](State& state) {
        run(state, [&]() -> Numbers {
            const std::size_t edges = size_of(take(resolve_fill(rings, rule)).rings);
            return {{"edges", static_cast<double>(size_of(rings))},
                    {"edges of the region", static_cast<double>(edges)}};
        });
    });
}

const bool fills_are_added = [] {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(0.0, 100.0);
    std::vector<Ring> discs;
    for (int i = 0; i < 100; ++i) {
        discs.push_back(wavy(place(random), place(random), 8.0, 100));
    }
    std::vector<Ring> layer;
    std::vector<Ring> tiling;
    for (int i = 0; i < 2500; ++i) {
        layer.push_back(rectangle(place(random), place(random), 2.0, 1.0));
        tiling.push_back(rectangle(i % 50, i / 50, 1.0, 1.0));
    }
    Ring chords;
    for (int i = 0; i < 1000; ++i) {
        chords.push_back({place(random), place(random)});
    }
    add_input("one outline, nonzero", {wavy(0.0, 0.0, 100.0, 10'000)}, FillRule::nonzero);
    add_input("100 overlapping outlines of 100 edges, nonzero", discs, FillRule::nonzero);
    add_input("2,500 overlapping rectangles, nonzero", layer, FillRule::nonzero);
    add_input("2,500 overlapping rectangles, union", layer, FillRule::union_of_parts);
    add_input("2,500 squares side by side, union", tiling, FillRule::union_of_parts);
    add_input("1,000 random chords, odd-even", {chords}, FillRule::odd_even);
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
