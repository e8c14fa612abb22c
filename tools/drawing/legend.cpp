#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/legend.hpp>
#include <tools/io/answer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <variant>

namespace nearfield::tools {
namespace {

constexpr double label_size = 21.0;

double middle(double a, double b) {
    return (a + b) / 2.0;
}

}  // namespace

std::string scale_number(double number, double step) {
    const double magnitude = std::max(std::abs(number), step);
    char text[48];
    if (magnitude >= 1e7 || step < 1e-4) {
        std::snprintf(text, sizeof text, "%.3g", std::abs(number));
    } else {
        const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
        std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(number));
    }
    return (number < 0.0 ? "\u2212" : "") + std::string(text);
}

void draw_color_bar(Canvas& canvas, const FieldScale& scale, const Rectangle& strip) {
    const double range = scale.highest - scale.lowest;
    if (!(range > 0.0)) {
        return;
    }
    const double height = strip.max.y - strip.min.y;
    const auto page_y = [&](double value) {
        return strip.max.y - (value - scale.lowest) / range * height;
    };
    for (int row = 0; row < height; ++row) {
        const double y = strip.min.y + row;
        const double value = scale.lowest + (strip.max.y - y - 0.5) / height * range;
        canvas.fill({{strip.min.x, y}, {strip.max.x, std::min(y + 1.0, strip.max.y)}},
                    diverging_color(scale.position(value)));
    }
    canvas.stroke(strip, {palette::frame, 1.5});
    const double step = round_step(range, 6.0);
    const auto first = std::lround(std::ceil(scale.lowest / step));
    const auto last = std::lround(std::floor(scale.highest / step));
    for (auto index = first; index <= last; ++index) {
        const double value = static_cast<double>(index) * step;
        const double y = page_y(value);
        const bool zero = index == 0;
        const std::vector<Vector2> tick{{zero ? strip.min.x : strip.max.x - 8.0, y},
                                        {strip.max.x, y}};
        canvas.stroke_open(std::span(&tick, 1),
                           {zero ? palette::shape_b : palette::text, zero ? 3.4 : 1.5});
        canvas.text({strip.max.x + 10.0, y + 0.36 * label_size},
                    zero ? "0" : scale_number(value, step), label_size, palette::text, Align::left,
                    zero ? Weight::bold : Weight::normal);
    }
}

void draw_scale_bar(Canvas& canvas, const View& view) {
    const Rectangle& page = view.page();
    const double longest = 0.22 * (page.max.x - page.min.x) / view.scale();
    const double length = round_step(longest, 1.0);
    const double pixels = length * view.scale();
    const std::string label = scale_number(length, length) + (length == 1.0 ? " unit" : " units");
    const double inner = std::max(pixels, canvas.text_width(label, label_size));
    const Vector2 corner{page.min.x + 18.0, page.max.y - 18.0};
    canvas.fill({{corner.x, corner.y - 58.0}, {corner.x + inner + 32.0, corner.y}},
                palette::page.with_alpha(0.86), 8.0);
    const double center = corner.x + 16.0 + inner / 2.0;
    const double left = center - pixels / 2.0;
    const double right = center + pixels / 2.0;
    const double y = corner.y - 16.0;
    const std::vector<std::vector<Vector2>> bar{{{left, y - 6.0}, {left, y + 3.0}},
                                                {{left, y}, {right, y}},
                                                {{right, y - 6.0}, {right, y + 3.0}}};
    canvas.stroke_open(bar, {palette::text, 2.4});
    canvas.text({center, y - 15.0}, label, label_size, palette::text, Align::center);
}

void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rectangle& area) {
    constexpr double line_height = 43.0;
    constexpr double symbol_width = 52.0;
    constexpr double symbol_height = 24.0;
    double y = area.min.y;
    for (const LegendEntry& entry : entries) {
        const Rectangle symbol{{area.min.x, y}, {area.min.x + symbol_width, y + symbol_height}};
        entry.symbol(canvas, symbol);
        const double x = symbol.max.x + 18.0;
        canvas.text({x, middle(symbol.min.y, symbol.max.y) + 0.36 * label_size},
                    canvas.shortened(entry.text, label_size, area.max.x - x), label_size,
                    palette::text);
        y += line_height;
    }
}

namespace {

double middle_y(const Rectangle& area) {
    return (area.min.y + area.max.y) / 2.0;
}

auto swatch(const Color& color) {
    return [color](Canvas& canvas, const Rectangle& area) {
        canvas.fill(area, color.with_alpha(0.30));
        canvas.stroke(area, {color, 2.4});
    };
}

auto line(const Pen& pen) {
    return [pen](Canvas& canvas, const Rectangle& area) {
        const std::vector<Vector2> line{{area.min.x, middle_y(area)}, {area.max.x, middle_y(area)}};
        canvas.stroke_open(std::span(&line, 1), pen);
    };
}

using DrawPair = void (*)(Canvas&, Vector2, Vector2);

auto pair_mark(DrawPair draw, bool with_point) {
    return [draw, with_point](Canvas& canvas, const Rectangle& area) {
        const Vector2 from{area.min.x + 8.0, middle_y(area)};
        draw(canvas, from, {area.max.x, middle_y(area)});
        if (with_point) {
            draw_point_mark(canvas, from);
        }
    };
}

void add_entries(std::vector<LegendEntry>& entries, const PenetrationResult& result) {
    if (result.count == 0) {
        return;
    }
    if (!result.points.empty()) {
        entries.push_back({pair_mark(draw_way_out, true), "point of A in B, its way out"});
    }
    entries.push_back({pair_mark(draw_deepest_mark, false), "the deepest point"});
}

void add_entries(std::vector<LegendEntry>& entries, const IntersectionResult&) {
    const auto symbol = [](Canvas& canvas, const Rectangle& area) {
        for (const double x : {area.min.x + 8.0, area.min.x + 25.0, area.min.x + 42.0}) {
            draw_sample_mark(canvas, {x, middle_y(area)}, 15.0);
        }
    };
    entries.push_back({symbol, "sample in both"});
}

void add_entries(std::vector<LegendEntry>&, const DistanceFieldResult&) {}

void add_entries(std::vector<LegendEntry>& entries, const ContactResult& result) {
    if (!result.points.empty()) {
        entries.push_back({pair_mark(draw_contact_mark, true), "contact, normal of B"});
    }
    if (!result.manifold.empty()) {
        entries.push_back({pair_mark(draw_stretch_mark, false), "stretch of contact, its ends"});
    }
}

void add_entries(std::vector<LegendEntry>& entries, const ClosestPointResult&) {
    entries.push_back(
        {pair_mark(draw_closest_pair, false), "closest point of A, its nearest of B"});
}

void add_entries(std::vector<LegendEntry>& entries, const SeparationResult&) {
    entries.push_back({pair_mark(draw_closest_pair, false), "closest points of A and B"});
}

void add_entries(std::vector<LegendEntry>& /*entries*/, const IntersectionTestResult& /*result*/) {}

void add_entries(std::vector<LegendEntry>& entries, const TimeOfImpactResult&) {
    entries.push_back({pair_mark(draw_closest_pair, false), "closest points of A and B then"});
    entries.push_back({line({palette::quiet_text, 2.2, {9.0, 6.0}}), "where it starts"});
    entries.push_back({line({palette::quiet_text, 2.2, {2.5, 4.5}}), "where it would end"});
}

void add_entries(std::vector<LegendEntry>& entries, const SeparationVectorResult& result) {
    if (result.intersects) {
        entries.push_back({pair_mark(draw_deepest_mark, false), "the way of A"});
        entries.push_back({line({palette::shape_a, 2.2, {2.5, 4.5}}), "A moved by it"});
    }
}

void add_entries(std::vector<LegendEntry>& entries, const ContainmentResult& result) {
    if (result.inside) {
        entries.push_back(
            {pair_mark(draw_closest_pair, false), "closest points of the boundaries"});
    }
}

/// Three features of one kind, side by side.
auto feature_colors(Feature::Kind kind) {
    return [kind](Canvas& canvas, const Rectangle& area) {
        const double width = (area.max.x - area.min.x) / 3.0;
        for (std::uint32_t index = 0; index < 3; ++index) {
            const double x = area.min.x + width * index;
            canvas.fill({{x, area.min.y}, {x + width, area.max.y}}, feature_color({kind, index}));
        }
        canvas.stroke(area, {palette::frame, 1.5});
    };
}

void draw_directions(Canvas& canvas, const Rectangle& area) {
    const double width = area.max.x - area.min.x;
    for (int column = 0; column < width; ++column) {
        const double angle = 2.0 * std::numbers::pi * column / width;
        const double x = area.min.x + column;
        canvas.fill({{x, area.min.y}, {x + 1.0, area.max.y}},
                    direction_color({std::cos(angle), std::sin(angle)}));
    }
    canvas.stroke(area, {palette::frame, 1.5});
}

void add_picture_entries(std::vector<LegendEntry>& entries, FieldPicture picture) {
    if (picture == FieldPicture::voronoi) {
        entries.push_back({feature_colors(Feature::Kind::edge), "nearest to an edge of B"});
        entries.push_back({feature_colors(Feature::Kind::vertex), "nearest to a vertex of B"});
    } else if (picture == FieldPicture::gradient) {
        const auto arrow = [](Canvas& canvas, const Rectangle& area) {
            draw_gradient_arrow(canvas, {(area.min.x + area.max.x) / 2.0, middle_y(area)},
                                {1.0, 0.0});
        };
        entries.push_back({arrow, "where the distance grows"});
        entries.push_back({draw_directions, "its direction: +x, +y, \u2212x, \u2212y"});
    }
}

const char* meaning_of_regions(QueryType type) {
    switch (type) {
        case QueryType::distance_field:
            return "grid of the field";
        case QueryType::contacts:
            return "region of potential contact";
        case QueryType::closest_point:
        case QueryType::separation:
            return "where the closest can be";
        case QueryType::penetration:
        case QueryType::intersection:
        case QueryType::intersection_test:
        case QueryType::time_of_impact:
        case QueryType::separation_vector:
        case QueryType::containment:
            break;
    }
    return "region of potential intersection";
}

}  // namespace

std::vector<LegendEntry> legend_of(const Figure& figure, const FieldScale* field) {
    std::vector<LegendEntry> entries{
        {swatch(palette::shape_a), "A: " + figure.a.name},
        {swatch(palette::shape_b), "B: " + figure.b.name},
    };
    if (!summary_of(figure.answer.result).regions.empty()) {
        entries.push_back({line({palette::region, 2.0, {9.0, 7.0}}),
                           meaning_of_regions(figure.answer.request.type)});
    }
    if (figure.answer.tiles != nullptr && !figure.answer.tiles->empty()) {
        entries.push_back({line({palette::tile, 1.8}), "tile"});
    }
    std::visit([&entries](const auto& result) { add_entries(entries, result); },
               figure.answer.result);
    add_picture_entries(entries, figure.answer.request.picture);
    if (field != nullptr) {
        const auto colors = [](Canvas& canvas, const Rectangle& area) {
            const double width = area.max.x - area.min.x;
            for (int column = 0; column < width; ++column) {
                const double x = area.min.x + column;
                const double along = column / width;
                canvas.fill({{x, area.min.y}, {x + 1.0, area.max.y}},
                            diverging_color(2.0 * along - 1.0));
            }
            canvas.stroke(area, {palette::frame, 1.5});
        };
        entries.push_back({colors, "distance to B, d = " + short_number(figure.field->tolerance)});
        entries.push_back({line({palette::text.with_alpha(0.5), 1.6}),
                           "line of equal distance, every " + short_number(field->iso_step)});
    }
    return entries;
}

}  // namespace nearfield::tools
