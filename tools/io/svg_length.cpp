#include <tools/io/svg_length.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace nearfield::tools {
namespace {

double whole_of(SvgAxis axis, const SvgViewport& viewport) {
    switch (axis) {
        case SvgAxis::x:
            return viewport.width;
        case SvgAxis::y:
            return viewport.height;
        case SvgAxis::other:
            break;
    }
    return std::hypot(viewport.width, viewport.height) / std::sqrt(2.0);
}

/// How preserveAspectRatio places a box in a viewport.
struct AspectRatio {
    double x = 0.5;  ///< 0: at the left, 1: at the right
    double y = 0.5;
    bool is_kept = true;
    bool is_slice = false;
};

AspectRatio parse_aspect_ratio(const SvgDocument& document, const pugi::xml_node& node) {
    std::string_view text = document.word(node, "preserveAspectRatio");
    constexpr std::string_view of_images = "defer ";
    if (text.starts_with(of_images)) {
        text = without_spaces(text.substr(of_images.size()));
    }
    AspectRatio ratio;
    if (text.empty()) {
        return ratio;
    }
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string_view place = text.substr(0, space);
    const std::string_view rule = without_spaces(text.substr(space));
    const auto part = [](std::string_view name) {
        return name == "Min" ? 0.0 : name == "Mid" ? 0.5 : name == "Max" ? 1.0 : -1.0;
    };
    ratio.is_kept = place != "none";
    if (ratio.is_kept) {
        const bool is_form = place.size() == 8 && place[0] == 'x' && place[4] == 'Y';
        ratio.x = is_form ? part(place.substr(1, 3)) : -1.0;
        ratio.y = is_form ? part(place.substr(5, 3)) : -1.0;
    }
    ratio.is_slice = rule == "slice";
    if (ratio.x < 0.0 || ratio.y < 0.0 || !is_one_of(rule, {"", "meet", "slice"})) {
        document.fail(node, "preserveAspectRatio is none of its forms, as xMidYMid meet");
    }
    return ratio;
}

}  // namespace

double parse_length(SvgText text, SvgAxis axis, const std::optional<SvgViewport>& viewport) {
    text.skip_space();
    const double number = text.number();
    const std::size_t start = text.position();
    double unit = 1.0;
    if (text.peek() == '%') {
        if (!viewport) {
            text.fail(start, "a percentage without a viewBox, or a width and height, to refer to");
        }
        text.advance();
        unit = whole_of(axis, *viewport) / 100.0;
    } else if (const std::string name = text.word(); name == "Q") {
        unit = 96.0 / 101.6;
    } else if (!name.empty()) {
        const std::optional<LengthUnit> found = find_named<LengthUnit>(name);
        if (!found || found == LengthUnit::user) {
            text.fail(start, "\"" + name + "\" is none of px, mm, cm, Q, in, pt, pc, %");
        }
        unit = pixels_per(*found);
    }
    text.skip_space();
    if (text.peek() != '\0') {
        text.fail(start, "expected a length: one number and its unit");
    }
    return number * unit;
}

std::optional<double> svg_length(const SvgDocument& document, const pugi::xml_node& node,
                                 const char* name, SvgAxis axis,
                                 const std::optional<SvgViewport>& viewport) {
    const std::optional<SvgText> text = document.property(node, name);
    if (!text || document.word(node, name) == "auto") {
        return std::nullopt;
    }
    return parse_length(*text, axis, viewport);
}

std::optional<SvgViewBox> svg_view_box(const SvgDocument& document, const pugi::xml_node& node,
                                       const std::optional<SvgViewport>& size) {
    std::optional<SvgText> text = document.attribute(node, "viewBox");
    if (!text) {
        return std::nullopt;
    }
    text->skip_space();
    const double x = text->number();
    const double y = text->next_number();
    const double width = text->next_number();
    const double height = text->next_number();
    text->skip_space();
    if (text->peek() != '\0') {
        text->fail("expected four numbers and no more");
    }
    if (!(width > 0.0 && height > 0.0)) {
        document.fail(node, "width and height of a viewBox have to be above 0");
    }
    SvgViewBox box{.viewport = {width, height}};
    const SvgViewport shown = size.value_or(box.viewport);
    if (!(shown.width > 0.0 && shown.height > 0.0)) {
        document.fail(node, "width and height of what a viewBox is shown in have to be above 0");
    }
    const AspectRatio ratio = parse_aspect_ratio(document, node);
    double scale_x = shown.width / width;
    double scale_y = shown.height / height;
    if (ratio.is_kept) {
        scale_x = ratio.is_slice ? std::max(scale_x, scale_y) : std::min(scale_x, scale_y);
        scale_y = scale_x;
    }
    box.map = {{scale_x, 0.0},
               {0.0, scale_y},
               {ratio.x * (shown.width - scale_x * width) - scale_x * x,
                ratio.y * (shown.height - scale_y * height) - scale_y * y}};
    if (!ratio.is_kept) {
        box.map.origin = {-scale_x * x, -scale_y * y};
    }
    return box;
}

}  // namespace nearfield::tools
