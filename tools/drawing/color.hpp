#pragma once

#include <cstdint>

namespace nearfield::tools {

/// A colour in sRGB; components from 0 to 1.
struct Color {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
    double alpha = 1.0;

    [[nodiscard]] constexpr Color with_alpha(double other) const {
        return {red, green, blue, other};
    }
};

/// A colour from six hexadecimal digits: rgb(0x1B2A41).
[[nodiscard]] constexpr Color rgb(unsigned digits) {
    return {static_cast<double>(digits >> 16U & 0xFFU) / 255.0,
            static_cast<double>(digits >> 8U & 0xFFU) / 255.0,
            static_cast<double>(digits & 0xFFU) / 255.0};
}

/// The colours of the parts of a figure.
namespace palette {
inline constexpr Color page = rgb(0xFFFFFF);
inline constexpr Color panel = rgb(0xF5F6F8);
inline constexpr Color text = rgb(0x1B2430);
inline constexpr Color quiet_text = rgb(0x5B6675);
inline constexpr Color frame = rgb(0xC3CAD3);
inline constexpr Color shape_a = rgb(0xC2185B);
inline constexpr Color shape_b = rgb(0x14467C);
inline constexpr Color region = rgb(0x1B2430);
inline constexpr Color tile = rgb(0x00796B);
inline constexpr Color arrow = rgb(0x1B2430);
inline constexpr Color sample = rgb(0x7B3FA0).with_alpha(0.62);
inline constexpr Color highlight = rgb(0xFFD21F);
}  // namespace palette

/// A colour from its hue in turns (0 and 1 are reddish), its chroma (0.1 is pastel) and its
/// lightness from 0 to 1; equal steps look equal.
[[nodiscard]] Color hue_color(double turns, double chroma, double lightness);

/// 0xAARRGGBB, opaque.
[[nodiscard]] std::uint32_t pixel_of(const Color& color);

/// The diverging colour map for signed distance: `position` runs from -1 (deepest inside) through 0
/// (the boundary, nearly white) to 1 (farthest outside). Lightness decreases evenly on both sides.
[[nodiscard]] Color diverging_color(double position);

/// The colour map for clearances: `position` runs from -1 (the greatest depth, dark red) to 0 (in
/// contact, red), and from just above 0 (yellow) through green to 1 (as clear as the scale goes,
/// blue).
[[nodiscard]] Color clearance_color(double position);

}  // namespace nearfield::tools
