#include <tools/io/svg_values.hpp>
#include <tools/io/svg_walk.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
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

/// True if a clip-path, as an element in this state has it, keeps the whole canvas: it refers to a
/// clipPath of one straight-edged convex outline of up to four edges that the canvas lies in, to
/// within a ten-thousandth of its diagonal. What it would cut off is not on the canvas.
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

constexpr int deepest = 1024;                 // untrusted input must not exhaust the stack
constexpr std::size_t most_work = 2'000'000;  // uses of uses multiply

AffineMap scaling(double factor) {
    return {{factor, 0.0}, {0.0, factor}, {}};
}

/// The corners of a viewport of this size, in which the coordinates of the content are shown by
/// `shown`, which only scales and moves, after another map of these coordinates.
std::array<Vector2, 4> corners_of(const AffineMap& shown, const SvgViewport& size,
                                  const AffineMap& map) {
    const auto mapped = [&](double x, double y) {
        return combine(translation((x - shown.origin.x) / shown.x_axis.x,
                                   (y - shown.origin.y) / shown.y_axis.y),
                       map)
            .origin;
    };
    return {mapped(0.0, 0.0), mapped(size.width, 0.0), mapped(size.width, size.height),
            mapped(0.0, size.height)};
}

/// Whether an element is for all who draw it: it asks for no extension, and for English if for a
/// language.
bool is_meant(const pugi::xml_node& node) {
    if (node.attribute("requiredExtensions")) {
        return false;
    }
    const pugi::xml_attribute languages = node.attribute("systemLanguage");
    if (!languages) {
        return true;
    }
    std::string_view left = languages.value();
    while (!left.empty()) {
        const std::size_t comma = std::min(left.find(','), left.size());
        const std::string_view language = without_spaces(left.substr(0, comma));
        if (language == "en" || language.starts_with("en-")) {
            return true;
        }
        left.remove_prefix(std::min(comma + 1, left.size()));
    }
    return false;
}

}  // namespace

/// The width and height of the outermost element, one of which may follow from its viewBox.
std::optional<SvgViewport> SvgWalk::window_of(const pugi::xml_node& root,
                                              const std::optional<SvgViewBox>& box) const {
    // A size in percent is that of a window that is not there.
    const auto size = [&](const char* name, SvgAxis axis) {
        const bool is_part = document_.word(root, name).ends_with('%');
        return is_part ? std::nullopt : svg_length(document_, root, name, axis, std::nullopt);
    };
    std::optional<double> width = size("width", SvgAxis::x);
    std::optional<double> height = size("height", SvgAxis::y);
    if (box && width && !height) {
        height = *width * (box->viewport.height / box->viewport.width);
    } else if (box && height && !width) {
        width = *height * (box->viewport.width / box->viewport.height);
    }
    return width && height ? std::optional(SvgViewport{*width, *height}) : std::nullopt;
}

std::optional<SvgState> SvgWalk::enter_root(LengthUnit unit) const {
    const pugi::xml_node root = document_.root();
    if (!document_.word(root, "transform").empty()) {
        document_.fail(root, "a transform of the outermost element is not read");
    }
    std::optional<SvgState> state = enter(root, SvgState());
    if (!state) {
        return std::nullopt;
    }
    const bool in_user_units = unit == LengthUnit::user;
    const std::optional<SvgViewBox> own = svg_view_box(document_, root, std::nullopt);
    const std::optional<SvgViewport> window = window_of(root, own);
    const bool has_area = !window || (window->width > 0.0 && window->height > 0.0);
    const std::optional<SvgViewBox> shown =
        has_area || !in_user_units ? svg_view_box(document_, root, window) : std::nullopt;
    const std::optional<SvgViewBox>& box = in_user_units ? own : shown;
    state->viewport = box ? std::optional(box->viewport) : window;
    if (!in_user_units) {
        const AffineMap in_pixels = box ? box->map : AffineMap();
        state->map = combine(in_pixels, scaling(1.0 / pixels_per(unit)));
    }
    state->map = combine(state->map, svg_to_world);
    if (has_area && (shown || window)) {
        const SvgViewBox canvas = shown.value_or(SvgViewBox());
        state->canvas = corners_of(canvas.map, window.value_or(canvas.viewport), state->map);
    }
    return state;
}

SvgRole SvgWalk::role_of(const pugi::xml_node& node) const {
    const std::string_view name = local_name(node);
    if (is_svg_shape(name)) {
        return SvgRole::shape;
    }
    if (name == "use") {
        return SvgRole::use;
    }
    if (is_one_of(name, {"g", "a", "svg", "switch"})) {
        return SvgRole::group;
    }
    if (is_one_of(name, {"text", "image", "line", "foreignObject", "video", "audio", "canvas",
                         "iframe", "flowRoot"})) {
        return SvgRole::skipped;
    }
    const bool is_definition = is_one_of(name, {"defs",
                                                "symbol",
                                                "title",
                                                "desc",
                                                "metadata",
                                                "style",
                                                "script",
                                                "clipPath",
                                                "mask",
                                                "marker",
                                                "pattern",
                                                "linearGradient",
                                                "radialGradient",
                                                "meshgradient",
                                                "hatch",
                                                "solidcolor",
                                                "filter",
                                                "view",
                                                "cursor",
                                                "color-profile",
                                                "font",
                                                "font-face",
                                                "animate",
                                                "animateMotion",
                                                "animateTransform",
                                                "animateColor",
                                                "set",
                                                "discard"});
    if (is_definition || name.find(':') != std::string_view::npos) {
        return SvgRole::nothing;
    }
    document_.fail(node,
                   "is no element that is read: path, polygon, polyline, rect, circle, "
                   "ellipse, g, use, symbol, svg, switch and a are");
}

std::vector<pugi::xml_node> SvgWalk::children_of(const pugi::xml_node& group) {
    const bool is_switch = local_name(group) == "switch";
    std::vector<pugi::xml_node> children;
    for (const pugi::xml_node& child : group.children()) {
        if (child.type() == pugi::node_element && is_meant(child) &&
            (!is_switch || children.empty())) {
            children.push_back(child);
        }
    }
    return children;
}

void SvgWalk::require_read(const pugi::xml_node& node) const {
    if (!is_one_of(document_.word(node, "mask"), {"", "none"})) {
        document_.fail(node, "mask is not read");
    }
    for (const char* const what : {"d", "translate", "rotate", "scale", "zoom", "offset-path"}) {
        const std::optional<std::string_view> value = document_.styled(node, what);
        if (value && *value != "none") {
            document_.fail(node, std::string(what) + " in a style is not read");
        }
    }
    if (document_.word(node, "transform").empty()) {
        return;
    }
    if (const std::string_view origin = document_.word(node, "transform-origin");
        !is_one_of(origin, {"", "0", "0 0", "0px 0px"})) {
        document_.fail(node, "transform-origin is not read");
    }
    if (!is_one_of(document_.word(node, "transform-box"), {"", "view-box"})) {
        document_.fail(node, "transform-box is not read");
    }
}

std::optional<SvgState> SvgWalk::enter(const pugi::xml_node& node, const SvgState& outer) const {
    if (document_.word(node, "display") == "none") {
        return std::nullopt;
    }
    if (outer.depth > deepest) {
        document_.fail(node, "elements nested too deep");
    }
    require_read(node);
    SvgState state = outer;
    ++state.depth;
    if (std::optional<SvgText> transform = document_.property(node, "transform")) {
        state.map = combine(parse_transform(*transform), outer.map);
    }
    if (const std::string_view clip = document_.word(node, "clip-path");
        !is_one_of(clip, {"", "none"}) && !keeps_canvas(document_, clip, state)) {
        document_.fail(node, "clip-path is not read, unless it keeps the whole canvas");
    }
    const std::string_view rule = document_.word(node, "fill-rule");
    if (rule == "evenodd") {
        state.rule = FillRule::odd_even;
    } else if (rule == "nonzero" || rule == "initial") {
        state.rule = FillRule::nonzero;
    } else if (!is_one_of(rule, {"", "inherit", "unset"})) {
        document_.fail(
            node, "the fill-rule \"" + std::string(rule) + "\" is neither nonzero nor evenodd");
    }
    const std::string_view visibility = document_.word(node, "visibility");
    if (visibility == "visible" || visibility == "initial") {
        state.is_visible = true;
    } else if (is_one_of(visibility, {"hidden", "collapse"})) {
        state.is_visible = false;
    } else if (!is_one_of(visibility, {"", "inherit", "unset"})) {
        document_.fail(node, "the visibility \"" + std::string(visibility) +
                                 "\" is none of visible, hidden, collapse");
    }
    return state;
}

void SvgWalk::count_work(const pugi::xml_node& node, std::size_t segments) {
    work_ += 1 + segments;
    if (!in_use_.empty() && work_ > most_work) {
        document_.fail(node, "is drawn too often: the file's uses draw more than " +
                                 std::to_string(most_work) + " elements and segments");
    }
}

void SvgWalk::draw(const pugi::xml_node& node, const SvgState& outer, SvgDrawing& drawing) {
    const SvgRole role = role_of(node);
    if (role == SvgRole::nothing) {
        return;
    }
    const std::optional<SvgState> state = enter(node, outer);
    if (!state) {
        return;
    }
    const bool is_inner_svg = role == SvgRole::group && local_name(node) == "svg";
    draw_inside(node, is_inner_svg ? inside_viewport(node, {}, *state) : *state, drawing);
}

void SvgWalk::draw_inside(const pugi::xml_node& node, const SvgState& state, SvgDrawing& drawing) {
    count_work(node, 0);
    switch (role_of(node)) {
        case SvgRole::nothing:  // a symbol, which is drawn where it is used
        case SvgRole::group:
            for (const pugi::xml_node& child : children_of(node)) {
                draw(child, state, drawing);
            }
            return;
        case SvgRole::use:
            if (const pugi::xml_node target = target_of(node)) {
                draw_target(node, target, placed(node, state), drawing);
            }
            return;
        case SvgRole::skipped:
            skipped_.add(local_name(node));
            return;
        case SvgRole::shape:
            break;
    }
    if (!state.is_visible) {
        return;
    }
    CurvePath outline = read_svg_shape(document_, node, state.viewport);
    FilledPart part{.rule = state.rule};
    for (const CurveContour& contour : outline.contours()) {
        part.contours += contour.segments.empty() ? 0U : 1U;
        count_work(node, contour.segments.size());
    }
    if (part.contours == 0) {
        skipped_.add(empty_part);
        return;
    }
    outline.transform(state.map);
    if (!outline.problem().empty()) {
        document_.fail(node, outline.problem());
    }
    drawing.path.append(outline);
    drawing.parts.push_back(part);
}

pugi::xml_node SvgWalk::target_of(const pugi::xml_node& use) const {
    std::string_view reference = document_.word(use, "href");
    if (reference.empty()) {
        for (const pugi::xml_attribute& attribute : use.attributes()) {
            if (std::string_view(attribute.name()).ends_with(":href")) {
                reference = attribute.value();
            }
        }
    }
    if (reference.empty()) {
        document_.fail(use, "needs the attribute href");
    }
    if (!reference.starts_with('#')) {
        document_.fail(use, "refers to \"" + std::string(reference) +
                                "\"; only what is in the file, as #ID, is read");
    }
    const pugi::xml_node target = document_.find_reference(reference.substr(1));
    if (!target) {
        document_.fail(
            use, "there is no element with the id \"" + std::string(reference.substr(1)) + "\"");
    }
    const bool is_drawn = local_name(target) == "symbol" || role_of(target) != SvgRole::nothing;
    return is_drawn ? target : pugi::xml_node();
}

SvgState SvgWalk::placed(const pugi::xml_node& node, const SvgState& state) const {
    SvgState moved = state;
    const double x = svg_length(document_, node, "x", SvgAxis::x, state.viewport).value_or(0.0);
    const double y = svg_length(document_, node, "y", SvgAxis::y, state.viewport).value_or(0.0);
    moved.map = combine(translation(x, y), state.map);
    return moved;
}

void SvgWalk::draw_target(const pugi::xml_node& use, const pugi::xml_node& target,
                          const SvgState& state, SvgDrawing& drawing) {
    if (std::find(in_use_.begin(), in_use_.end(), target) != in_use_.end()) {
        document_.fail(use, "uses itself");
    }
    in_use_.push_back(target);
    if (is_one_of(local_name(target), {"symbol", "svg"})) {
        if (const std::optional<SvgState> entered = enter(target, state)) {
            draw_inside(target, inside_viewport(target, use, *entered), drawing);
        }
    } else {
        draw(target, state, drawing);
    }
    in_use_.pop_back();
}

SvgState SvgWalk::inside_viewport(const pugi::xml_node& node, const pugi::xml_node& use,
                                  const SvgState& state) const {
    const auto length = [&](const char* name, SvgAxis axis) {
        std::optional<double> value;
        if (use) {
            value = svg_length(document_, use, name, axis, state.viewport);
        }
        return value ? value : svg_length(document_, node, name, axis, state.viewport);
    };
    SvgState inner = placed(node, state);
    std::optional<SvgViewport> size = state.viewport;
    const std::optional<double> width = length("width", SvgAxis::x);
    const std::optional<double> height = length("height", SvgAxis::y);
    if (width && height) {
        size = SvgViewport{*width, *height};
    } else if (size) {
        size = SvgViewport{width.value_or(size->width), height.value_or(size->height)};
    }
    if (node.attribute("viewBox") && !size) {
        document_.fail(node, "a viewBox needs width and height here");
    }
    if (const std::optional<SvgViewBox> box = svg_view_box(document_, node, size)) {
        inner.map = combine(box->map, inner.map);
        inner.viewport = box->viewport;
    } else {
        inner.viewport = size;
    }
    return inner;
}

}  // namespace nearfield::tools
