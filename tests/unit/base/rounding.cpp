#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

// Compiled with the options of the modules, not with those of tests (tests/CMakeLists.txt).

namespace nearfield {
namespace {

struct Pair {
    double x = 0.0;
    double y = 0.0;
};

struct FloatPair {
    float x = 0.0F;
    float y = 0.0F;
};

[[gnu::noinline]] Pair rest_of(Pair p) {
    const FloatPair rounded{static_cast<float>(p.x), static_cast<float>(p.y)};
    return {p.x - static_cast<double>(rounded.x), p.y - static_cast<double>(rounded.y)};
}

[[gnu::noinline]] void split(const std::array<Pair, 8>& from, std::array<FloatPair, 8>& high,
                             std::array<FloatPair, 8>& low) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        high[i] = {static_cast<float>(from[i].x), static_cast<float>(from[i].y)};
        low[i] = {static_cast<float>(from[i].x - static_cast<double>(high[i].x)),
                  static_cast<float>(from[i].y - static_cast<double>(high[i].y))};
    }
}

[[gnu::noinline]] Pair sums_of_products(Pair a, Pair b, Pair c) {
    return {a.x * b.x + c.x, a.y * b.y - c.y};
}

/// Numbers that the compiler does not know.
volatile double unknown[] = {0.1, 0.7, 1.0 + 0x1p-30};

/// The number less the float nearest to it, by integers. For numbers whose exponent a float has.
double rest_by_bits(double number) {
    constexpr std::uint64_t dropped = (1ULL << 29U) - 1;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(number);
    const std::uint64_t half_up = bits + (dropped >> 1U) + (bits >> 29U & 1U);
    return number - std::bit_cast<double>(half_up & ~dropped);
}

TEST(Rounding, OfAConversionToFloatIsNotDropped) {
    const Pair numbers_of_pair{unknown[0], unknown[1]};
    const Pair rest = rest_of(numbers_of_pair);
    EXPECT_EQ(rest.x, rest_by_bits(numbers_of_pair.x));
    EXPECT_EQ(rest.y, rest_by_bits(numbers_of_pair.y));
    EXPECT_NE(rest.x, 0.0);
    std::array<Pair, 8> numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = {unknown[0] * static_cast<double>(i + 1),
                      -1e6 * unknown[1] / static_cast<double>(i + 3)};
    }
    std::array<FloatPair, 8> high;
    std::array<FloatPair, 8> low;
    split(numbers, high, low);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        EXPECT_EQ(low[i].x, static_cast<float>(rest_by_bits(numbers[i].x)));
        EXPECT_EQ(low[i].y, static_cast<float>(rest_by_bits(numbers[i].y)));
    }
}

TEST(Rounding, OfAProductIsNotFusedWithASum) {
    // The exact product is 1 + 2^-29 + 2^-60; only its first two terms fit.
    const double number = unknown[2];
    const Pair found =
        sums_of_products({number, number}, {number, number}, {-1.0 - 0x1p-29, 1.0 + 0x1p-29});
    EXPECT_EQ(found.x, 0.0);
    EXPECT_EQ(found.y, 0.0);
}

}  // namespace
}  // namespace nearfield
