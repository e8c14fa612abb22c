#include <tools/drawing/canvas.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <stdexcept>

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

namespace {

void require(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error(std::string("the picture cannot be drawn: ") +
                                 cairo_status_to_string(status));
    }
}

/// Continuation bytes of UTF-8 belong to the preceding character.
bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_.get())) {
    require(cairo_status(context_.get()));
    cairo_set_fill_rule(context_.get(), CAIRO_FILL_RULE_EVEN_ODD);
    cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
    set(background);
    cairo_paint(context_.get());
}

void Canvas::set(const Color& color) {
    cairo_set_source_rgba(context_.get(), color.red, color.green, color.blue, color.alpha);
}

void Canvas::set(const Pen& pen) {
    set(pen.color);
    cairo_set_line_width(context_.get(), pen.width);
    cairo_set_dash(context_.get(), pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0.0);
}

void Canvas::clip(const Rectangle& rectangle) {
    cairo_save(context_.get());
    cairo_rectangle(context_.get(), rectangle.min.x, rectangle.min.y,
                    rectangle.max.x - rectangle.min.x, rectangle.max.y - rectangle.min.y);
    cairo_clip(context_.get());
}

void Canvas::unclip() {
    cairo_restore(context_.get());
}

void Canvas::trace(std::span<const std::vector<Vector2>> lines, bool closed) {
    cairo_new_path(context_.get());
    for (const std::vector<Vector2>& line : lines) {
        cairo_new_sub_path(context_.get());
        for (const Vector2& point : line) {
            cairo_line_to(context_.get(), point.x, point.y);
        }
        if (closed) {
            cairo_close_path(context_.get());
        }
    }
}

void Canvas::fill(std::span<const std::vector<Vector2>> rings, const Color& color) {
    trace(rings, true);
    set(color);
    cairo_fill(context_.get());
}

void Canvas::stroke(std::span<const std::vector<Vector2>> rings, const Pen& pen) {
    trace(rings, true);
    set(pen);
    cairo_stroke(context_.get());
}

void Canvas::stroke_open(std::span<const std::vector<Vector2>> lines, const Pen& pen) {
    trace(lines, false);
    set(pen);
    cairo_stroke(context_.get());
}

void Canvas::fill(const Rectangle& rectangle, const Color& color, double corner_radius) {
    constexpr double quarter = std::numbers::pi / 2.0;
    const auto [low, high] = rectangle;
    const double r = corner_radius;
    cairo_new_path(context_.get());
    cairo_arc(context_.get(), high.x - r, low.y + r, r, -quarter, 0.0);
    cairo_arc(context_.get(), high.x - r, high.y - r, r, 0.0, quarter);
    cairo_arc(context_.get(), low.x + r, high.y - r, r, quarter, 2.0 * quarter);
    cairo_arc(context_.get(), low.x + r, low.y + r, r, 2.0 * quarter, 3.0 * quarter);
    cairo_close_path(context_.get());
    set(color);
    cairo_fill(context_.get());
}

void Canvas::stroke(const Rectangle& rectangle, const Pen& pen) {
    const auto [low, high] = rectangle;
    const std::vector<Vector2> corners{low, {high.x, low.y}, high, {low.x, high.y}};
    stroke(std::span(&corners, 1), pen);
}

void Canvas::dot(Vector2 center, double radius, const Color& color) {
    cairo_new_path(context_.get());
    cairo_arc(context_.get(), center.x, center.y, radius, 0.0, 2.0 * std::numbers::pi);
    set(color);
    cairo_fill(context_.get());
}

void Canvas::arrow(Vector2 from, Vector2 to, double head, const Pen& pen) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length < head) {
        const std::vector<Vector2> shaft{from, to};
        stroke_open(std::span(&shaft, 1), pen);
        return;
    }
    const Vector2 along{(to.x - from.x) / length, (to.y - from.y) / length};
    const Vector2 base{to.x - along.x * head, to.y - along.y * head};
    const double half_width = 0.38 * head;
    const std::vector<Vector2> shaft{from, base};
    const std::vector<Vector2> tip{to,
                                   {base.x - along.y * half_width, base.y + along.x * half_width},
                                   {base.x + along.y * half_width, base.y - along.x * half_width}};
    stroke_open(std::span(&shaft, 1), pen);
    fill(std::span(&tip, 1), pen.color);
}

void Canvas::image(std::span<const std::uint32_t> pixels, int width, int height, Vector2 corner) {
    const std::unique_ptr<cairo_surface_t, DestroySurface> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    require(cairo_surface_status(surface.get()));
    cairo_surface_flush(surface.get());
    unsigned char* const rows = cairo_image_surface_get_data(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const auto row_length = static_cast<std::size_t>(width);
    for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
        std::memcpy(rows + row * stride, pixels.data() + row * row_length,
                    row_length * sizeof(std::uint32_t));
    }
    cairo_surface_mark_dirty(surface.get());
    cairo_set_source_surface(context_.get(), surface.get(), corner.x, corner.y);
    cairo_new_path(context_.get());
    cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
    cairo_fill(context_.get());
}

void Canvas::select_font(double size, Weight weight) {
    cairo_select_font_face(
        context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
        weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_.get(), size);
}

void Canvas::text(Vector2 position, const std::string& text, double size, const Color& color,
                  Align align, Weight weight) {
    const Vector2 start = start_of_text(position, text, size, align, weight);
    set(color);
    cairo_move_to(context_.get(), start.x, start.y);
    cairo_show_text(context_.get(), text.c_str());
}

/// Selects the font, too.
Vector2 Canvas::start_of_text(Vector2 position, const std::string& text, double size, Align align,
                              Weight weight) {
    const double width = text_width(text, size, weight);
    const double shift = align == Align::left ? 0.0 : align == Align::center ? width / 2.0 : width;
    return {position.x - shift, position.y};
}

double Canvas::text_width(const std::string& text, double size, Weight weight) {
    select_font(size, weight);
    cairo_text_extents_t extents;
    cairo_text_extents(context_.get(), text.c_str(), &extents);
    return extents.x_advance;
}

std::string Canvas::shortened(std::string text, double size, double width, Weight weight) {
    if (text_width(text, size, weight) <= width) {
        return text;
    }
    const std::string ellipsis = "\u2026";
    while (!text.empty() && text_width(text + ellipsis, size, weight) > width) {
        while (text.size() > 1 && is_continuation(text.back())) {
            text.pop_back();
        }
        text.pop_back();
    }
    return text + ellipsis;
}

std::vector<std::vector<Ring>> Canvas::text_outlines(Vector2 position, const std::string& text,
                                                     double size, Align align, Weight weight) {
    std::vector<std::vector<Ring>> outlines;
    Vector2 start = start_of_text(position, text, size, align, weight);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t first = at++;
        while (at < text.size() && is_continuation(text[at])) {
            ++at;
        }
        const std::string character = text.substr(first, at - first);
        const double advance = text_width(character, size, weight);
        cairo_new_path(context_.get());
        // At the origin: Cairo leaves out what lies far from the page.
        cairo_move_to(context_.get(), 0.0, 0.0);
        cairo_text_path(context_.get(), character.c_str());
        outlines.push_back(rings_of_path(start));
        start.x += advance;
    }
    return outlines;
}

/// The closed lines of the current path, moved to an origin; curves become short edges.
std::vector<Ring> Canvas::rings_of_path(Vector2 origin) {
    const std::unique_ptr<cairo_path_t, decltype(&cairo_path_destroy)> path(
        cairo_copy_path_flat(context_.get()), cairo_path_destroy);
    require(path->status);
    const std::span data(path->data, static_cast<std::size_t>(path->num_data));
    std::vector<Ring> rings;
    for (std::size_t at = 0; at < data.size();) {
        const auto& header = data[at].header;
        if (header.type == CAIRO_PATH_MOVE_TO) {
            rings.emplace_back();
        }
        if (header.type != CAIRO_PATH_CLOSE_PATH) {
            rings.back().push_back(
                {origin.x + data[at + 1].point.x, origin.y + data[at + 1].point.y});
        }
        at += static_cast<std::size_t>(header.length);
    }
    // After each closed line Cairo starts another, of one point.
    std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
    return rings;
}

std::vector<std::uint32_t> Canvas::pixels() const {
    cairo_surface_flush(surface_.get());
    const auto width = static_cast<std::size_t>(cairo_image_surface_get_width(surface_.get()));
    const auto height = static_cast<std::size_t>(cairo_image_surface_get_height(surface_.get()));
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
    const unsigned char* const rows = cairo_image_surface_get_data(surface_.get());
    std::vector<std::uint32_t> pixels(width * height);
    for (std::size_t row = 0; row < height; ++row) {
        std::memcpy(pixels.data() + row * width, rows + row * stride,
                    width * sizeof(std::uint32_t));
    }
    return pixels;
}

std::string Canvas::png() const {
    std::string bytes;
    const auto append = [](void* closure, const unsigned char* data, unsigned length) {
        static_cast<std::string*>(closure)->append(data, data + length);
        return CAIRO_STATUS_SUCCESS;
    };
    require(cairo_status(context_.get()));
    require(cairo_surface_write_to_png_stream(surface_.get(), append, &bytes));
    return bytes;
}

}  // namespace nearfield::tools
