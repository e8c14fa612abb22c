// Measures what resolve_fill() costs and prints a table in Markdown: outlines of 10,000 edges, and
// random chords, which cross everywhere. Processor time, which other programs disturb less.

#include <nearfield/fill.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <random>
#include <vector>

namespace {

using nearfield::FillRule;
using nearfield::Ring;

constexpr int repetitions = 25;

struct Input {
    const char* name;
    std::vector<Ring> rings;
    FillRule rule;
};

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

std::vector<Input> inputs() {
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
    return {{"one outline", {wavy(0.0, 0.0, 100.0, 10'000)}, FillRule::nonzero},
            {"100 overlapping outlines of 100 edges", discs, FillRule::nonzero},
            {"2,500 overlapping rectangles", layer, FillRule::nonzero},
            {"2,500 overlapping rectangles", layer, FillRule::union_of_parts},
            {"2,500 squares side by side", tiling, FillRule::union_of_parts},
            {"1,000 random chords", {chords}, FillRule::odd_even}};
}

const char* name_of(FillRule rule) {
    switch (rule) {
        case FillRule::odd_even:
            return "odd-even";
        case FillRule::nonzero:
            return "nonzero";
        case FillRule::positive:
            return "positive";
        case FillRule::union_of_parts:
            return "union";
    }
    return "";
}

std::size_t size_of(const std::vector<Ring>& rings) {
    std::size_t size = 0;
    for (const Ring& ring : rings) {
        size += ring.size();
    }
    return size;
}

}  // namespace

int main() {
    std::printf("| rings | rule | edges | edges of the region | median ms | least ms |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const Input& input : inputs()) {
        std::vector<double> times;
        std::size_t edges = 0;
        for (int i = 0; i < repetitions; ++i) {
            const std::clock_t start = std::clock();
            const auto fill = nearfield::resolve_fill(input.rings, input.rule);
            const auto ticks = static_cast<double>(std::clock() - start);
            if (!fill.has_value()) {
                std::fprintf(stderr, "%s\n", fill.error().text().c_str());
                return 1;
            }
            edges = size_of(fill->rings);
            times.push_back(1e3 * ticks / CLOCKS_PER_SEC);
        }
        std::sort(times.begin(), times.end());
        std::printf("| %s | %s | %zu | %zu | %.1f | %.1f |\n", input.name, name_of(input.rule),
                    size_of(input.rings), edges, times[times.size() / 2], times.front());
    }
    return 0;
}
