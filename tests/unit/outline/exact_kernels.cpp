#include <engine/outline/exact_kernels.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/winding_oracle.hpp>

#include <cmath>
#include <cstdint>
#include <random>

namespace nearfield::outline {
namespace {

using exact::Axis;
using exact::Crossing;
using test::side_of;
using test::WholePlace;
using test::Wide;

/// Random points in whole numbers, many of them on or next to a line through others.
class RandomPlaces {
public:
    explicit RandomPlaces(std::int64_t largest) : largest_(largest) {}

    WholePlace any() { return {whole(-largest_, largest_), whole(-largest_, largest_)}; }
    /// Near the line through two points.
    WholePlace near_line(const WholePlace& a, const WholePlace& b) {
        const double part = std::uniform_real_distribution<double>(-0.5, 1.5)(random_);
        return {a.x + std::llround(part * static_cast<double>(b.x - a.x)) + whole(-1, 1),
                a.y + std::llround(part * static_cast<double>(b.y - a.y)) + whole(-1, 1)};
    }
    /// Exactly on a line through a point.
    WholePlace on_line(const WholePlace& a, const WholePlace& step) {
        const std::int64_t steps = whole(-1000, 1000);
        return {a.x + steps * step.x, a.y + steps * step.y};
    }
    std::int64_t whole(std::int64_t low, std::int64_t high) {
        return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
    }

private:
    std::int64_t largest_;
    std::mt19937_64 random_{1};
};

Vector2 point(const WholePlace& place, double unit) {
    return {static_cast<double>(place.x) * unit, static_cast<double>(place.y) * unit};
}

TEST(ExactKernels, OrientationHasNoRounding) {
    RandomPlaces places(std::int64_t{1} << 51U);
    for (int i = 0; i < 100'000; ++i) {
        const double unit = std::ldexp(1.0, static_cast<int>(places.whole(-190, 8)));
        const WholePlace a = places.any();
        const WholePlace b = i % 2 == 0 ? places.any() : places.on_line(a, {i % 1000, 999 - i});
        const WholePlace c =
            i % 2 == 0 ? places.near_line(a, b) : places.on_line(a, {i % 1000, 999 - i});
        ASSERT_EQ(exact::orientation(point(a, unit), point(b, unit), point(c, unit)),
                  side_of(a, b, c));
    }
}

/// Coordinates of different magnitudes: differences round, and only the full expansion decides.
TEST(ExactKernels, OrientationOfDifferentMagnitudes) {
    RandomPlaces places(100);
    for (int i = 0; i < 100'000; ++i) {
        // c is on the line from a to b but for the tiny part that b or c has.
        const double tiny = std::ldexp(1.0, -static_cast<int>(places.whole(60, 190)));
        const auto dx = static_cast<double>(places.whole(1, 1000));
        const auto dy = static_cast<double>(places.whole(1, 1000));
        const Vector2 a{tiny, 0.0};
        const Vector2 b{dx, dy};
        const Vector2 c{2.0 * dx, 2.0 * dy};
        // cross(b - a, c - a) = (dx - tiny) 2 dy - dy (2 dx - tiny) = -tiny dy
        ASSERT_EQ(exact::orientation(a, b, c), -1);
        ASSERT_EQ(exact::orientation(b, a, c), 1);
        ASSERT_EQ(exact::orientation({-tiny, 0.0}, b, c), 1);
        ASSERT_EQ(exact::orientation({0.0, 0.0}, b, c), 0);
    }
}

/// The sign of the crossing's x less value, in whole numbers.
int compare_x(const WholePlace& a, const WholePlace& b, const WholePlace& c, const WholePlace& d,
              std::int64_t value) {
    const Wide of_a =
        static_cast<Wide>(d.x - c.x) * (b.y - c.y) - static_cast<Wide>(d.y - c.y) * (b.x - c.x);
    const Wide of_b =
        static_cast<Wide>(d.x - c.x) * (a.y - c.y) - static_cast<Wide>(d.y - c.y) * (a.x - c.x);
    const Wide sum = of_b * (b.x - value) - of_a * (a.x - value);
    const int sign = (sum > 0 ? 1 : 0) - (sum < 0 ? 1 : 0);
    return of_b > 0 ? sign : -sign;
}

bool cross(const WholePlace& a, const WholePlace& b, const WholePlace& c, const WholePlace& d) {
    return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

TEST(ExactKernels, CoordinatesOfCrossingsAreComparedWithoutRounding) {
    RandomPlaces places(std::int64_t{1} << 36U);
    int crossings = 0;
    int hits = 0;
    for (int i = 0; i < 100'000; ++i) {
        const WholePlace a = places.any();
        const WholePlace b = places.any();
        const WholePlace c = i % 2 == 0 ? places.any() : places.near_line(a, b);
        const WholePlace d = i % 2 == 0 ? places.any() : places.near_line(a, b);
        if (!cross(a, b, c, d)) {
            continue;
        }
        ++crossings;
        const Crossing crossing{point(a, 1.0), point(b, 1.0), point(c, 1.0), point(d, 1.0)};
        const std::int64_t guess = std::llround(exact::approximate_coordinate(crossing, Axis::x));
        const Crossing turned{{crossing.a.y, crossing.a.x},
                              {crossing.b.y, crossing.b.x},
                              {crossing.c.y, crossing.c.x},
                              {crossing.d.y, crossing.d.x}};
        for (std::int64_t value = guess - 2; value <= guess + 2; ++value) {
            const int wanted = compare_x(a, b, c, d, value);
            const auto limit = static_cast<double>(value);
            ASSERT_EQ(exact::compare_coordinate(crossing, Axis::x, limit), wanted);
            ASSERT_EQ(exact::compare_coordinate(turned, Axis::y, limit), wanted);
            hits += wanted == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(crossings, 10'000);
    // Segments that cross exactly at a place.
    for (int i = 0; i < 20'000; ++i) {
        const WholePlace at = places.any();
        const WholePlace first{places.whole(1, 1000), places.whole(-1000, 1000)};
        const WholePlace second{places.whole(-1000, 1000), places.whole(1, 1000)};
        const WholePlace a{at.x - 3 * first.x, at.y - 3 * first.y};
        const WholePlace b{at.x + 7 * first.x, at.y + 7 * first.y};
        const WholePlace c{at.x - 5 * second.x, at.y - 5 * second.y};
        const WholePlace d{at.x + 2 * second.x, at.y + 2 * second.y};
        if (cross(a, b, c, d)) {
            const Crossing crossing{point(a, 1.0), point(b, 1.0), point(c, 1.0), point(d, 1.0)};
            const auto limit = static_cast<double>(at.x);
            ASSERT_EQ(exact::compare_coordinate(crossing, Axis::x, limit), 0);
            ASSERT_EQ(exact::compare_coordinate(crossing, Axis::x, limit - 0x1p-15), 1);
            ASSERT_EQ(exact::compare_coordinate(crossing, Axis::x, limit + 0x1p-15), -1);
            ++hits;
        }
    }
    EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace nearfield::outline
