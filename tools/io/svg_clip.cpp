#include <tools/io/svg_clip.hpp>
#include <tools/io/svg_length.hpp>
#include <tools/io/svg_shapes.hpp>
#include <tools/io/values.hpp>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

namespace nearfield::tools {
namespace {

/// The id in url(#ID), with or without quotes; empty for anything else.
std::string_view referred_id(std::string_view value) {
    if (!value.starts_with("url(") || !value.ends_with(')')) {
        return {};
    }
    value = without_spaces(value.substr(4, value.size() - 5));
    const bool has_quotes = value.size() > 1 && (value.front() == '"' || value.front() == '\'') &&
                            value.back() == value.front();
    value = has_quotes ? value.substr(1, value.size() - 2) : value;
    return value.starts_with('#') ? value.substr(1) : std::string_view();
}

/// True if no property changes what an element of a clip-path lets through.
bool is_plain(const SvgDocument& document, const pugi::xml_node& node) {
    const auto is = [&](const char* name, std::initializer_list<std::string_view> words) {
        return is_one_of(document.word(node, name), words);
    };
    return is("clip-path", {"", "none"}) && is("mask", {"", "none"}) &&
           is("transform-origin", {"", "0", "0 0", "0px 0px"}) &&
           is("transform-box", {"", "view-box"}) && is("visibility", {"", "visible"}) &&
           !is("display", {"none"});
}

/// The only outline of a clipPath in user units; a null node if it is anything else.
pugi::xml_node only_outline(const SvgDocument& document, const pugi::xml_node& clip) {
    if (local_name(clip) != "clipPath" || !is_plain(document, clip) ||
        !document.word(clip, "transform").empty() ||
        !is_one_of(document.word(clip, "clipPathUnits"), {"", "userSpaceOnUse"})) {
        return {};
    }
    std::vector<pugi::xml_node> children = SvgWalk::children_of(clip);
    std::erase_if(children, [](const pugi::xml_node& child) {
        return is_one_of(local_name(child), {"title", "desc", "metadata"});
    });
    return children.size() == 1 && is_svg_shape(local_name(children.front())) &&
                   is_plain(document, children.front())
               ? children.front()
               : pugi::xml_node();
}

/// The corners of an outline of up to four straight edges; none if it is another one.
std::vector<Vector2> corners_of(const CurvePath& outline) {
    std::vector<Vector2> corners;
    for (const CurveContour& contour : outline.contours()) {
        if (!corners.empty()) {
            return {};
        }
        corners.push_back(contour.start);
        for (const CurveSegment& segment : contour.segments) {
            if (segment.kind != CurveSegment::Kind::line) {
                return {};
            }
            if (!(segment.to == corners.back() || segment.to == corners.front())) {
                corners.push_back(segment.to);
            }
        }
    }
    return corners.size() > 4 ? std::vector<Vector2>() : corners;
}

double cross(const Vector2& a, const Vector2& b, const Vector2& point) {
    return (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
}

}  // namespace

bool keeps_canvas(const SvgDocument& document, std::string_view clip_path, const SvgState& state) {
    const pugi::xml_node clip = document.find_reference(referred_id(clip_path));
    const pugi::xml_node node = clip ? only_outline(document, clip) : pugi::xml_node();
    if (!node || !state.canvas) {
        return false;
    }
    CurvePath outline = read_svg_shape(document, node, state.viewport);
    AffineMap map = state.map;
    if (std::optional<SvgText> transform = document.property(node, "transform")) {
        map = combine(parse_transform(*transform), map);
    }
    outline.transform(map);
    const std::vector<Vector2> corners = corners_of(outline);
    if (corners.size() < 3) {
        return false;
    }
    constexpr double rounding = 1e-4;  // of the sizes in files
    const double margin = rounding * std::hypot(state.canvas->at(0).x - state.canvas->at(2).x,
                                                state.canvas->at(0).y - state.canvas->at(2).y);
    bool is_left = true;
    bool is_right = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector2& from = corners[i];
        const Vector2& to = corners[(i + 1) % corners.size()];
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        for (const Vector2& corner : *state.canvas) {
            const double side = cross(from, to, corner);
            is_left = is_left && side >= -margin * length;
            is_right = is_right && side <= margin * length;
        }
    }
    return is_left != is_right;
}

}  // namespace nearfield::tools
