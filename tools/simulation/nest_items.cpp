#include <tools/benchmark/outlines.hpp>
#include <tools/simulation/gear_train.hpp>
#include <tools/simulation/nest_items.hpp>
#include <tools/simulation/plane.hpp>

#include <cstdint>
#include <numbers>
#include <utility>

namespace nearfield::simulation {
namespace {

Ring circle(double radius, std::size_t vertices, Vector2 center = {}) {
    Ring ring;
    for (std::size_t i = 0; i < vertices; ++i) {
        const double turn = static_cast<double>(i) / static_cast<double>(vertices);
        ring.push_back(center + polar(radius, 2.0 * std::numbers::pi * turn));
    }
    return ring;
}

Ring scaled(Ring ring, double scale) {
    for (Vector2& vertex : ring) {
        vertex = scale * vertex;
    }
    return ring;
}

NestItem wheel() {
    return {gear_outline(9), circle(0.55, 20)};
}

NestItem washer() {
    return {circle(1.2, 32), circle(0.78, 24)};
}

NestItem channel() {
    return {{{-1.1, -0.9},
             {1.1, -0.9},
             {1.1, 0.9},
             {0.7, 0.9},
             {0.7, -0.45},
             {-0.7, -0.45},
             {-0.7, 0.9},
             {-1.1, 0.9}}};
}

NestItem bracket() {
    return {{{-0.9, -1.1},
             {1.2, -1.1},
             {1.2, -0.5},
             {0.1, -0.3},
             {-0.2, 0.1},
             {-0.3, 1.2},
             {-0.9, 1.2}},
            circle(0.18, 12, {-0.6, 0.8}),
            circle(0.18, 12, {0.8, -0.8})};
}

NestItem hook() {
    return {scaled(benchmark::link(30), 0.6)};
}

NestItem gusset() {
    return {{{-0.9, -0.7}, {1.3, -0.7}, {1.3, -0.5}, {-0.7, 1.3}, {-0.9, 1.3}},
            {{-0.5, -0.35}, {0.35, -0.35}, {-0.5, 0.45}}};
}

NestItem scrap(std::uint64_t seed) {
    return {scaled(benchmark::coast(seed, 40), 0.75)};
}

NestItem star(std::uint64_t seed) {
    benchmark::Random random(seed);
    return {scaled(benchmark::star(random, 14), 0.62)};
}

}  // namespace

std::vector<NestItem> nest_items() {
    std::vector<NestItem> items;
    for (const auto make : {wheel, washer, hook, bracket, channel, gusset}) {
        for (int i = 0; i < 4; ++i) {
            items.push_back(make());
        }
    }
    for (const auto make : {scrap, star}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            items.push_back(make(seed));
        }
    }
    return items;
}

}  // namespace nearfield::simulation
