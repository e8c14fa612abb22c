#pragma once

#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

/// Shapes of many edges whose boxes overlap: a tree of boxes does not tell which edge is near.
namespace nearfield::samples {

/// Regular rings inside each other, scaled about `centre`; every `repeat`-th one comes twice.
inline test::Rings nested(std::uint32_t rings, std::uint32_t sides, const Vector2& centre,
                          std::uint32_t repeat) {
    test::Rings all;
    for (std::uint32_t i = 0; i < rings; ++i) {
        const double scale = 1.0 - 0.95 * i / rings;
        Ring ring;
        for (std::uint32_t k = 0; k < sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / sides;
            ring.push_back({centre.x + scale * (std::cos(angle) - centre.x),
                            centre.y + scale * (std::sin(angle) - centre.y)});
        }
        all.push_back(ring);
        if (i % repeat == repeat - 1) {
            all.push_back(ring);
        }
    }
    return all;
}

/// Squares inside each other on a grid of whole numbers.
inline test::Rings nested_squares(std::uint32_t count) {
    test::Rings all;
    for (std::uint32_t i = 1; i <= count; ++i) {
        const double half = i;
        all.push_back({{0.0, -half}, {half, 0.0}, {0.0, half}, {-half, 0.0}});
        all.push_back(test::rectangle({-half, -half}, {half, half}).front());
    }
    return all;
}

inline std::vector<test::NamedRings> awkward_shapes(test::Random& random) {
    Ring spikes;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 3000;
        const double radius = i % 2 == 0 ? 0.3 : random.between(0.9, 1.0);
        spikes.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return {{"nested pentagons", nested(600, 5, {0.0, 0.0}, 10000)},
            {"nested triangles with a common vertex", nested(900, 3, {1.0, 0.0}, 10000)},
            {"nested rings, some on each other", nested(400, 6, {0.0, 0.0}, 3)},
            {"nested squares", nested_squares(300)},
            {"spikes", {spikes}}};
}

}  // namespace nearfield::samples
