#include <engine/base/sine_series.hpp>
#include <engine/geometry/angle_kernels.hpp>

#include <array>
#include <cmath>
#include <cstddef>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/geometry/angle_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nearfield::geometry::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The same operations in the same order as in engine/base/portable_math.cpp; no product is fused
// with a sum.

constexpr std::size_t max_angles = 8;
using AngleTag = hn::CappedTag<double, max_angles>;
using AngleLanes = hn::Vec<AngleTag>;

/// Unevaluated sums.
struct PartLanes {
    AngleLanes high;
    AngleLanes low;
};

HWY_INLINE AngleLanes all(double value) {
    return hn::Set(AngleTag(), value);
}

HWY_INLINE PartLanes sum_of(AngleLanes a, AngleLanes b) {
    const AngleLanes high = hn::Add(a, b);
    const AngleLanes of_b = hn::Sub(high, a);
    return {high, hn::Add(hn::Sub(a, hn::Sub(high, of_b)), hn::Sub(b, of_b))};
}

/// Angles less these multiples of a quarter turn.
HWY_INLINE PartLanes less_quarters(AngleLanes angles, AngleLanes quarters) {
    const auto part = [&](std::size_t i) HWY_ATTR {
        return hn::Mul(quarters, all(trigonometry::half_pi_parts[i]));
    };
    const PartLanes less_two = sum_of(hn::Sub(angles, part(0)), hn::Neg(part(1)));
    const PartLanes less_three = sum_of(less_two.high, hn::Neg(part(2)));
    const AngleLanes rest = hn::Sub(hn::Add(less_two.low, less_three.low), part(3));
    return sum_of(less_three.high, rest);
}

template <std::size_t count>
HWY_INLINE AngleLanes value_at(const std::array<double, count>& series, AngleLanes z) {
    AngleLanes value = all(series.front());
    for (std::size_t i = 1; i < count; ++i) {
        value = hn::Add(all(series[i]), hn::Mul(z, value));
    }
    return value;
}

HWY_INLINE AngleLanes sines_of(const PartLanes& angles) {
    const AngleLanes x = angles.high;
    const AngleLanes z = hn::Mul(x, x);
    const AngleLanes series = value_at(trigonometry::sine_series, z);
    const AngleLanes of_low = hn::Mul(angles.low, hn::Sub(all(1.0), hn::Mul(all(0.5), z)));
    return hn::Add(x, hn::Add(hn::Mul(hn::Mul(x, z), series), of_low));
}

HWY_INLINE AngleLanes cosines_of(const PartLanes& angles) {
    const AngleLanes x = angles.high;
    const AngleLanes z = hn::Mul(x, x);
    const AngleLanes series = value_at(trigonometry::cosine_series, z);
    const AngleLanes half = hn::Mul(all(0.5), z);
    const AngleLanes leading = hn::Sub(all(1.0), half);
    const AngleLanes rounding = hn::Sub(hn::Sub(all(1.0), leading), half);
    const AngleLanes rest = hn::Sub(hn::Mul(hn::Mul(z, z), series), hn::Mul(x, angles.low));
    return hn::Add(leading, hn::Add(rounding, rest));
}

/// Angles of fewer than trigonometry::many_quarters.
HWY_INLINE void write_sines_cosines(AngleLanes angles, double* interleaved) {
    const AngleTag tag;
    const AngleLanes turns = hn::Div(angles, all(trigonometry::half_pi));
    // What is at most an eighth of a turn stays as it is.
    const auto is_small = hn::Le(hn::Abs(angles), all(trigonometry::half_pi / 2));
    const AngleLanes quarters = hn::IfThenZeroElse(is_small, hn::Floor(hn::Add(turns, all(0.5))));
    const PartLanes reduced = less_quarters(angles, quarters);
    const AngleLanes sine = sines_of(reduced);
    const AngleLanes cosine = cosines_of(reduced);
    // From 0 to 3.
    const AngleLanes quarter =
        hn::Sub(quarters, hn::Mul(all(4.0), hn::Floor(hn::Mul(quarters, all(0.25)))));
    const auto is_odd = hn::Or(hn::Eq(quarter, all(1.0)), hn::Eq(quarter, all(3.0)));
    const auto is_below = hn::Ge(quarter, all(2.0));
    const auto is_left = hn::Or(hn::Eq(quarter, all(1.0)), hn::Eq(quarter, all(2.0)));
    const AngleLanes up = hn::IfThenElse(is_odd, cosine, sine);
    const AngleLanes right = hn::IfThenElse(is_odd, sine, cosine);
    hn::StoreInterleaved2(hn::IfThenElse(is_below, hn::Neg(up), up),
                          hn::IfThenElse(is_left, hn::Neg(right), right), tag, interleaved);
}

void FindSinesCosines(const double* angles, std::size_t count, SineCosine* results) {
    const AngleTag tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::size_t i = 0; i < count; i += lanes) {
        const std::size_t some = count - i < lanes ? count - i : lanes;
        double of_lanes[max_angles] = {};
        double interleaved[2 * max_angles];
        for (std::size_t lane = 0; lane < some; ++lane) {
            const bool is_large = !(std::abs(angles[i + lane]) < trigonometry::many_quarters);
            of_lanes[lane] = is_large ? 0.0 : angles[i + lane];
        }
        write_sines_cosines(hn::LoadU(tag, of_lanes), interleaved);
        for (std::size_t lane = 0; lane < some; ++lane) {
            const double angle = angles[i + lane];
            results[i + lane] = std::abs(angle) < trigonometry::many_quarters
                                    ? SineCosine{interleaved[2 * lane], interleaved[2 * lane + 1]}
                                    : sine_cosine(angle);
        }
    }
}

}  // namespace nearfield::geometry::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::geometry::kernels {

HWY_EXPORT(FindSinesCosines);

void find_sines_cosines(std::span<const double> angles, std::span<SineCosine> results) {
    HWY_DYNAMIC_DISPATCH(FindSinesCosines)(angles.data(), angles.size(), results.data());
}

}  // namespace nearfield::geometry::kernels
#endif
