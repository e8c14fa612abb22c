#include <tools/drawing/color.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace nearfield::tools {
namespace {

/// A colour in Oklab, where equal steps look equal.
struct Lab {
    double lightness;
    double a;
    double b;
};

/// The colours of one side of a map, from the boundary to the extreme.
using Ramp = std::array<Lab, 4>;

// Both sides have the same lightness at each step.
constexpr Ramp inside{{{0.985, -0.002, -0.004},
                       {0.865, -0.028, -0.055},
                       {0.735, -0.045, -0.090},
                       {0.600, -0.045, -0.115}}};
constexpr Ramp outside{
    {{0.985, 0.002, 0.006}, {0.905, 0.018, 0.052}, {0.810, 0.040, 0.090}, {0.690, 0.062, 0.108}}};
// Red to dark red; yellow by way of green to blue.
constexpr Ramp overlapping{
    {{0.680, 0.170, 0.080}, {0.580, 0.190, 0.100}, {0.480, 0.165, 0.085}, {0.380, 0.130, 0.060}}};
constexpr Ramp clear{{{0.890, 0.010, 0.165},
                      {0.810, -0.095, 0.125},
                      {0.700, -0.100, -0.005},
                      {0.570, -0.035, -0.125}}};

double to_srgb(double linear) {
    const double clamped = std::clamp(linear, 0.0, 1.0);
    return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

Color to_color(const Lab& lab) {
    const double l = std::pow(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3.0);
    const double m = std::pow(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3.0);
    const double s = std::pow(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3.0);
    return {to_srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            to_srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            to_srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// The colour at a position from 0, the boundary, to 1, the extreme.
Color color_along(const Ramp& side, double position) {
    const double along = std::min(position, 1.0) * static_cast<double>(side.size() - 1);
    const std::size_t index = std::min(static_cast<std::size_t>(along), side.size() - 2);
    const double weight = along - static_cast<double>(index);
    const Lab& from = side[index];
    const Lab& to = side[index + 1];
    return to_color({std::lerp(from.lightness, to.lightness, weight),
                     std::lerp(from.a, to.a, weight), std::lerp(from.b, to.b, weight)});
}

}  // namespace

Color hue_color(double turns, double chroma, double lightness) {
    const double angle = 2.0 * std::numbers::pi * turns;
    return to_color({lightness, chroma * std::cos(angle), chroma * std::sin(angle)});
}

std::uint32_t pixel_of(const Color& color) {
    const auto byte = [](double part) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(part, 0.0, 1.0) * 255.0));
    };
    return 0xFF000000U | byte(color.red) << 16U | byte(color.green) << 8U | byte(color.blue);
}

Color diverging_color(double position) {
    return color_along(position < 0.0 ? inside : outside, std::abs(position));
}

Color clearance_color(double position) {
    return color_along(position > 0.0 ? clear : overlapping, std::abs(position));
}

}  // namespace nearfield::tools
