#include <nearfield/portable_math.hpp>

#include <tools/benchmark/crowds.hpp>
#include <tools/benchmark/objects.hpp>
#include <tools/benchmark/outlines.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::benchmark {
namespace {

constexpr std::size_t star_vertices = 50;

double any_angle(Random& random) {
    return random.between(0.0, 2.0 * std::numbers::pi);
}

void add_star(tools::Scene& scene, Random& random, Vector2 place) {
    Ring ring = star(random, star_vertices);  // fixes the evaluation order: before the angle
    add_object(scene, {std::move(ring)}, {place, any_angle(random)});
}

}  // namespace

tools::Scene crowd_scene(std::size_t objects) {
    constexpr double spacing = 1.716;
    constexpr double jitter = 0.25;
    constexpr double columns_to_rows = 1.6;
    const auto columns = static_cast<std::size_t>(
        std::lround(std::sqrt(columns_to_rows * static_cast<double>(objects))));
    tools::Scene scene;
    Random random(1);
    for (std::size_t index = 0; index < objects; ++index) {
        const Vector2 place = in_rows(index, columns, {spacing, spacing});
        const Vector2 aside{random.between(-jitter, jitter), random.between(-jitter, jitter)};
        add_star(scene, random, {place.x + aside.x, place.y + aside.y});
    }
    return scene;
}

tools::Scene small_pairs_scene(std::size_t pairs) {
    constexpr double apart = 1.3;
    tools::Scene scene;
    Random random(3);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const Vector2 place = in_rows(pair, 100, {5.0, 5.0});
        add_star(scene, random, place);
        const double angle = any_angle(random);
        const auto [sine, cosine] = sine_cosine(angle);
        add_star(scene, random, {place.x + apart * cosine, place.y + apart * sine});
    }
    return scene;
}

}  // namespace nearfield::benchmark
