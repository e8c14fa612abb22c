#include <engine/base/sine_series.hpp>
#include <nearfield/portable_math.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

// Additions, multiplications, divisions, square roots, std::floor and std::fma are exactly rounded
// everywhere; nothing else is used here.

namespace nearfield {
namespace {

using trigonometry::half_pi;
using trigonometry::half_pi_rest;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// An unevaluated sum.
struct TwoParts {
    double high = 0.0;
    double low = 0.0;
};

TwoParts sum(double a, double b) {
    const double high = a + b;
    const double of_b = high - a;
    return {high, (a - (high - of_b)) + (b - of_b)};
}

/// An angle less a multiple of a quarter turn: from -pi/4 to pi/4, up to rounding.
struct Reduced {
    TwoParts angle;
    std::uint32_t quarters = 0;  ///< the multiple, modulo 4
};

/// For fewer than `many_quarters`.
Reduced reduce_small(double angle) {
    const auto& [first, second, third, fourth] = trigonometry::half_pi_parts;
    const double quarters = std::floor(angle / half_pi + 0.5);
    const TwoParts less_two = sum(angle - quarters * first, -(quarters * second));
    const TwoParts less_three = sum(less_two.high, -(quarters * third));
    const double rest = less_two.low + less_three.low - quarters * fourth;
    return {sum(less_three.high, rest),
            static_cast<std::uint32_t>(static_cast<std::int64_t>(quarters)) & 3U};
}

// The binary digits of 2/pi after the point.
constexpr std::array<std::uint32_t, 38> two_over_pi{
    0xA2F9836E, 0x4E441529, 0xFC2757D1, 0xF534DDC0, 0xDB629599, 0x3C439041, 0xFE5163AB, 0xDEBBC561,
    0xB7246E3A, 0x424DD2E0, 0x06492EEA, 0x09D1921C, 0xFE1DEB1C, 0xB129A73E, 0xE88235F5, 0x2EBB4484,
    0xE99C7026, 0xB45F7E41, 0x3991D639, 0x835339F4, 0x9C845F8B, 0xBDF9283B, 0x1FF897FF, 0xDE05980F,
    0xEF2F118B, 0x5A0A6D1F, 0x6D367ECF, 0x27CB09B7, 0x4F463F66, 0x9E5FEA2D, 0x7527BAC7, 0xEBE5F17B,
    0x3D0739F7, 0x8A5292EA, 0x6BFB5FB1, 0x1F8D5D08, 0x56033046, 0xFC7B6BAB};

/// Digits that can matter: fewer would not leave 60 bits of a multiple that is almost whole.
constexpr std::size_t words = 7;

/// For positive angles of any size: multiplies by the digits of 2/pi that are neither multiples of
/// a whole turn nor too small to matter.
Reduced reduce_large(double angle) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(angle);
    const int exponent = static_cast<int>(bits >> 52U) - 1075;
    const std::uint64_t mantissa = (bits & ((1ULL << 52U) - 1)) | 1ULL << 52U;
    const std::size_t skipped = exponent >= 2 ? static_cast<std::size_t>(exponent - 2) / 32 : 0;
    // The product's words, the lowest first.
    std::array<std::uint32_t, words + 2> product{};
    for (std::size_t half = 0; half < 2; ++half) {
        const std::uint64_t factor = half == 0 ? mantissa & 0xFFFFFFFFU : mantissa >> 32U;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < words; ++i) {
            carry += factor * two_over_pi[skipped + words - 1 - i] + product[i + half];
            product[i + half] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
        product[words + half] = static_cast<std::uint32_t>(carry);
    }
    // Quarters are the product's bits from `point` on.
    const int point = static_cast<int>(32 * (skipped + words)) - exponent;
    const auto word_at = [&](int bit) {  // 32 bits from `bit` on
        const auto index = static_cast<std::size_t>(bit / 32);
        const std::uint64_t next = index + 1 < product.size() ? product[index + 1] : 0;
        return static_cast<std::uint32_t>((next << 32U | product[index]) >> (bit % 32));
    };
    std::uint32_t quarters = word_at(point) & 3U;
    const bool round_up = word_at(point - 32) >> 31U != 0;
    quarters += round_up ? 1 : 0;
    TwoParts fraction;
    double unit = 0x1p-160;
    std::uint64_t borrow = round_up ? 1 : 0;
    for (int bit = point - 160; bit < point; bit += 32, unit *= 0x1p32) {
        // The fraction, or one less the fraction: its complement plus one.
        std::uint64_t word = word_at(bit);
        if (round_up) {
            word = (~word & 0xFFFFFFFFU) + borrow;
            borrow = word >> 32U;
            word &= 0xFFFFFFFFU;
        }
        const TwoParts next = sum(static_cast<double>(word) * unit, fraction.high);
        fraction = {next.high, next.low + fraction.low};
    }
    const double sign = round_up ? -1.0 : 1.0;
    const double high = fraction.high * half_pi;
    const double low = std::fma(fraction.high, half_pi, -high) +
                       (fraction.high * half_pi_rest + fraction.low * half_pi);
    const TwoParts reduced = sum(high, low);
    return {{sign * reduced.high, sign * reduced.low}, quarters & 3U};
}

Reduced reduce(double angle) {
    if (std::abs(angle) <= half_pi / 2) {
        return {{angle, 0.0}, 0};
    }
    if (std::abs(angle) < trigonometry::many_quarters) {
        return reduce_small(angle);
    }
    Reduced reduced = reduce_large(std::abs(angle));
    if (angle < 0.0) {
        reduced.angle = {-reduced.angle.high, -reduced.angle.low};
        reduced.quarters = (4 - reduced.quarters) & 3U;
    }
    return reduced;
}

/// A series in powers of z.
template <std::size_t count>
double value_of(const std::array<double, count>& series, double z) {
    double value = series.front();
    for (std::size_t i = 1; i < count; ++i) {
        value = series[i] + z * value;
    }
    return value;
}

double sine_of(const TwoParts& angle) {
    const double x = angle.high;
    const double z = x * x;
    const double series = value_of(trigonometry::sine_series, z);
    return x + (x * z * series + angle.low * (1.0 - 0.5 * z));
}

double cosine_of(const TwoParts& angle) {
    const double x = angle.high;
    const double z = x * x;
    const double series = value_of(trigonometry::cosine_series, z);
    const double leading = 1.0 - 0.5 * z;
    const double rounding = (1.0 - leading) - 0.5 * z;
    return leading + (rounding + (z * z * series - x * angle.low));
}

/// The arc tangent of a number from 0 to 1.
double arc_tangent_of(double tangent) {
    const double z = tangent * tangent;
    const double guess =
        tangent * (0.999866 + z * (-0.3302995 + z * (0.180141 + z * (-0.085133 + z * 0.0208351))));
    // The guess is off by at most a part in 7000, so the fifth power of the correction is nothing.
    const double sine = sine_of({guess, 0.0});
    const double cosine = cosine_of({guess, 0.0});
    const double correction = (tangent * cosine - sine) / (cosine + tangent * sine);
    return guess + (correction - correction * correction * correction / 3.0);
}

}  // namespace

SineCosine sine_cosine(double angle) noexcept {
    if (!std::isfinite(angle)) {
        return {not_a_number, not_a_number};
    }
    const Reduced reduced = reduce(angle);
    const double sine = sine_of(reduced.angle);
    const double cosine = cosine_of(reduced.angle);
    switch (reduced.quarters) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

double arc_tangent(double y, double x) noexcept {
    if (!std::isfinite(x) || !std::isfinite(y)) {
        return not_a_number;
    }
    const double least = std::min(std::abs(x), std::abs(y));
    const double most = std::max(std::abs(x), std::abs(y));
    double angle = most == 0.0 ? 0.0 : arc_tangent_of(least / most);
    if (std::abs(y) > std::abs(x)) {
        angle = half_pi - (angle - half_pi_rest);
    }
    if (x < 0.0) {
        angle = 2.0 * half_pi - (angle - 2.0 * half_pi_rest);
    }
    return std::copysign(angle, y);
}

}  // namespace nearfield
