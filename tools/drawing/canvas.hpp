#pragma once

#include <nearfield/shape.hpp>

#include <cairo.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

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

enum class Align { left, center, right };
enum class Weight { normal, bold };

/// The style of a line.
struct Pen {
    Color color;
    double width = 1.0;
    std::vector<double> dashes = {};
};

/// A page of pixels to draw on: x to the right, y down. Hides the Cairo objects.
class Canvas {
public:
    Canvas(int width, int height, const Color& background);

    /// Clips drawing to a rectangle until unclip().
    void clip(const Rectangle& rectangle);
    void unclip();

    /// Fills and strokes closed lines; they are filled together by the odd-even rule.
    void fill(std::span<const std::vector<Vector2>> rings, const Color& color);
    void stroke(std::span<const std::vector<Vector2>> rings, const Pen& pen);
    /// Strokes open lines together: at crossings, a translucent colour is applied once.
    void stroke_open(std::span<const std::vector<Vector2>> lines, const Pen& pen);

    void fill(const Rectangle& rectangle, const Color& color, double corner_radius = 0.0);
    void stroke(const Rectangle& rectangle, const Pen& pen);
    void dot(Vector2 center, double radius, const Color& color);
    /// Draws a shaft and, if it is long enough, a filled head at `to`.
    void arrow(Vector2 from, Vector2 to, double head, const Pen& pen);

    /// Draws pixels, 0xAARRGGBB with alpha 255, at scale 1 with the lower corner at `corner`.
    void image(std::span<const std::uint32_t> pixels, int width, int height, Vector2 corner);

    /// Draws a line of text; its baseline starts, is centred or ends at `position`.
    void text(Vector2 position, const std::string& text, double size, const Color& color,
              Align align = Align::left, Weight weight = Weight::normal);
    [[nodiscard]] double text_width(const std::string& text, double size,
                                    Weight weight = Weight::normal);
    /// Returns the text, truncated with an ellipsis if it is wider than `width`.
    [[nodiscard]] std::string shortened(std::string text, double size, double width,
                                        Weight weight = Weight::normal);

    /// The outlines of the characters of such a line, one by one, for the odd-even rule.
    [[nodiscard]] std::vector<std::vector<Ring>> text_outlines(Vector2 position,
                                                               const std::string& text, double size,
                                                               Align align = Align::left,
                                                               Weight weight = Weight::normal);

    /// The current page, 0xAARRGGBB, row by row.
    [[nodiscard]] std::vector<std::uint32_t> pixels() const;
    /// The current page as a PNG file.
    [[nodiscard]] std::string png() const;

private:
    struct DestroySurface {
        void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    };
    struct DestroyContext {
        void operator()(cairo_t* context) const { cairo_destroy(context); }
    };

    void set(const Color& color);
    void set(const Pen& pen);
    void select_font(double size, Weight weight);
    void trace(std::span<const std::vector<Vector2>> lines, bool closed);
    [[nodiscard]] Vector2 start_of_text(Vector2 position, const std::string& text, double size,
                                        Align align, Weight weight);
    [[nodiscard]] std::vector<Ring> rings_of_path(Vector2 origin);

    std::unique_ptr<cairo_surface_t, DestroySurface> surface_;
    std::unique_ptr<cairo_t, DestroyContext> context_;
};

}  // namespace nearfield::tools
