#include <nearfield/portable_math.hpp>

#include <tools/io/svg_values.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

double radians(double degrees) {
    return std::remainder(degrees, 360.0) * (std::numbers::pi / 180.0);
}

Vector2 mapped(const AffineMap& map, const Vector2& v) {
    return {v.x * map.x_axis.x + v.y * map.y_axis.x, v.x * map.x_axis.y + v.y * map.y_axis.y};
}

AffineMap rotation(double degrees) {
    const auto [sine, cosine] = sine_cosine(radians(degrees));
    return {{cosine, sine}, {-sine, cosine}, {}};
}

double tangent(double degrees) {
    const auto [sine, cosine] = sine_cosine(radians(degrees));
    return sine / cosine;
}

/// What a unit behind a number, as CSS has it, makes of the number: pixels and degrees are what
/// numbers alone are in.
double unit_of(SvgText& text, const std::string& function) {
    const std::size_t start = text.position();
    const std::string unit = text.word();
    if (unit.empty()) {
        return 1.0;
    }
    if (function == "rotate" || function.starts_with("skew")) {
        for (const auto& [name, degrees] :
             {std::pair{"deg", 1.0}, std::pair{"grad", 0.9},
              std::pair{"rad", 180.0 / std::numbers::pi}, std::pair{"turn", 360.0}}) {
            if (unit == name) {
                return degrees;
            }
        }
        text.fail(start, "\"" + unit + "\" is none of deg, grad, rad, turn");
    }
    const std::optional<LengthUnit> length = find_named<LengthUnit>(unit);
    if (!function.starts_with("translate") || !length || length == LengthUnit::user) {
        text.fail(start, "\"" + unit + "\" is no unit of " + function);
    }
    return pixels_per(*length);
}

/// The map for one function, from its name and arguments.
AffineMap one_transform(const SvgText& text, std::size_t start, const std::string& name,
                        const std::vector<double>& n) {
    const auto takes = [&](std::initializer_list<std::size_t> counts, const char* form) {
        for (const std::size_t count : counts) {
            if (n.size() == count) {
                return;
            }
        }
        text.fail(start,
                  name + " takes " + form + ", not " + std::to_string(n.size()) + " numbers");
    };
    if (name == "matrix") {
        takes({6}, "six numbers");
        return {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}};
    }
    if (name == "translate") {
        takes({1, 2}, "one or two numbers");
        return translation(n[0], n.size() > 1 ? n[1] : 0.0);
    }
    if (name == "translateX" || name == "translateY") {
        takes({1}, "one number");
        return name.back() == 'X' ? translation(n[0], 0.0) : translation(0.0, n[0]);
    }
    if (name == "scaleX" || name == "scaleY") {
        takes({1}, "one number");
        return name.back() == 'X' ? AffineMap{{n[0], 0.0}, {0.0, 1.0}, {}}
                                  : AffineMap{{1.0, 0.0}, {0.0, n[0]}, {}};
    }
    if (name == "scale") {
        takes({1, 2}, "one or two numbers");
        return {{n[0], 0.0}, {0.0, n.size() > 1 ? n[1] : n[0]}, {}};
    }
    if (name == "rotate") {
        takes({1, 3}, "one or three numbers");
        if (n.size() == 1) {
            return rotation(n[0]);
        }
        return combine(combine(translation(-n[1], -n[2]), rotation(n[0])), translation(n[1], n[2]));
    }
    if (name == "skewX") {
        takes({1}, "one number");
        return {{1.0, 0.0}, {tangent(n[0]), 1.0}, {}};
    }
    if (name == "skewY") {
        takes({1}, "one number");
        return {{1.0, tangent(n[0])}, {0.0, 1.0}, {}};
    }
    text.fail(start, "\"" + name + "\" is none of matrix, translate, scale, rotate, skewX, skewY");
}

}  // namespace

AffineMap translation(double x, double y) {
    return {{1.0, 0.0}, {0.0, 1.0}, {x, y}};
}

AffineMap combine(const AffineMap& first, const AffineMap& then) {
    const Vector2 origin = mapped(then, first.origin);
    return {mapped(then, first.x_axis),
            mapped(then, first.y_axis),
            {origin.x + then.origin.x, origin.y + then.origin.y}};
}

AffineMap parse_transform(SvgText& text) {
    AffineMap result;
    text.skip_separator();
    while (text.peek() != '\0') {
        const std::size_t start = text.position();
        const std::string name = text.word();
        if (name.empty()) {
            text.fail("expected the name of a transform");
        }
        if (name == "none" && text.peek() != '(') {
            text.skip_separator();
            continue;
        }
        text.expect('(');
        std::vector<double> numbers;
        text.skip_space();
        while (text.peek() != ')') {
            const double number = text.number();
            numbers.push_back(number * unit_of(text, name));
            text.skip_separator();
        }
        text.expect(')');
        // Functions further to the right are applied first.
        result = combine(one_transform(text, start, name, numbers), result);
        text.skip_separator();
    }
    return result;
}

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

namespace {

class PathParser {
public:
    explicit PathParser(SvgText& text) : text_(text) {}

    CurvePath parse() {
        text_.skip_space();
        if (to_upper(text_.peek()) != 'M') {
            text_.fail("path data begins with M or m");
        }
        while (text_.peek() != '\0') {
            parse_command();
            text_.skip_space();
        }
        return std::move(path_);
    }

private:
    void parse_command() {
        char command = text_.peek();
        if (!is_in("MmLlHhVvCcSsQqTtAaZz", command)) {
            text_.fail(std::string("'") + command + "' is no command of path data");
        }
        text_.advance();
        if (to_upper(command) == 'Z') {
            path_.close();
            current_ = start_;
            previous_ = 'Z';
            return;
        }
        bool first = true;
        do {
            relative_ = command >= 'a';
            text_.skip_space();
            draw(to_upper(command));
            // Further pairs after a move are lines.
            if (first && to_upper(command) == 'M') {
                command = relative_ ? 'l' : 'L';
            }
            first = false;
        } while (more_follows());
    }

    /// True if another set of arguments follows, which repeats the command.
    bool more_follows() {
        text_.skip_space();
        if (text_.peek() == ',') {
            text_.skip_separator();
            if (!text_.number_follows()) {
                text_.fail("expected a number after the comma");
            }
        }
        return text_.number_follows();
    }

    Vector2 point(bool first) {
        const double x = first ? text_.number() : text_.next_number();
        const double y = text_.next_number();
        return relative_ ? Vector2{current_.x + x, current_.y + y} : Vector2{x, y};
    }

    /// The reflection of the previous control point if the previous command is one of these, else
    /// the current point.
    [[nodiscard]] Vector2 reflected(std::string_view commands) const {
        return is_in(commands, previous_)
                   ? Vector2{2.0 * current_.x - control_.x, 2.0 * current_.y - control_.y}
                   : current_;
    }

    void draw(char command) {
        Vector2 to;
        switch (command) {
            case 'M':
                to = point(true);
                path_.move_to(to);
                start_ = to;
                break;
            case 'L':
                to = point(true);
                path_.line_to(to);
                break;
            case 'H':
                to = {text_.number() + (relative_ ? current_.x : 0.0), current_.y};
                path_.line_to(to);
                break;
            case 'V':
                to = {current_.x, text_.number() + (relative_ ? current_.y : 0.0)};
                path_.line_to(to);
                break;
            case 'C':
            case 'S': {
                const Vector2 first = command == 'C' ? point(true) : reflected("CS");
                control_ = point(command == 'S');
                to = point(false);
                path_.cubic_to(first, control_, to);
                break;
            }
            case 'Q':
            case 'T':
                control_ = command == 'Q' ? point(true) : reflected("QT");
                to = point(command == 'T');
                path_.quadratic_to(control_, to);
                break;
            default:
                to = arc();
        }
        current_ = to;
        previous_ = command;
    }

    Vector2 arc() {
        EllipticArc arc;
        arc.radius_x = text_.number();
        arc.radius_y = text_.next_number();
        arc.rotation = text_.next_number() * (std::numbers::pi / 180.0);
        text_.skip_separator();
        arc.large = text_.flag();
        text_.skip_separator();
        arc.counter_clockwise = text_.flag();  // from x towards y, as SVG's sweep flag means
        const Vector2 to = point(false);
        path_.arc_to(arc, to);
        return to;
    }

    SvgText& text_;
    CurvePath path_;
    Vector2 start_;  // of the subpath
    Vector2 current_;
    Vector2 control_;  // the last control point of a curve
    char previous_ = '\0';
    bool relative_ = false;
};

}  // namespace

CurvePath parse_path_data(SvgText& text) {
    return PathParser(text).parse();
}

CurvePath parse_path_file(const std::string& text, const std::string& file) {
    SvgText data(text, 0, text, file);
    return parse_path_data(data).transform(svg_to_world);
}

namespace {

/// Reads the attributes of one element.
class ShapeReader {
public:
    ShapeReader(const SvgDocument& document, const pugi::xml_node& node,
                const std::optional<SvgViewport>& viewport)
        : document_(document), node_(node), viewport_(viewport) {}

    [[nodiscard]] CurvePath read(std::string_view name) const {
        if (name == "path") {
            const bool is_none = document_.word(node_, "d") == "none";
            std::optional<SvgText> data = is_none ? std::nullopt : text("d");
            return data ? parse_path_data(*data) : CurvePath();
        }
        if (name == "polygon" || name == "polyline") {
            return read_points();
        }
        if (name == "rect") {
            return read_rectangle();
        }
        const Vector2 centre{length("cx", SvgAxis::x).value_or(0.0),
                             length("cy", SvgAxis::y).value_or(0.0)};
        CurvePath path;
        if (name == "circle") {
            const double radius = size("r", SvgAxis::other);
            return radius > 0.0 ? path.circle(centre, radius) : path;
        }
        const std::optional<double> given_x = given_size("rx", SvgAxis::x);
        const std::optional<double> given_y = given_size("ry", SvgAxis::y);
        // A single radius applies to both axes.
        const double rx = given_x ? *given_x : given_y.value_or(0.0);
        const double ry = given_y ? *given_y : rx;
        return rx > 0.0 && ry > 0.0 ? path.ellipse(centre, rx, ry) : path;
    }

private:
    /// An attribute without which nothing is drawn.
    [[nodiscard]] std::optional<SvgText> text(const char* name) const {
        std::optional<SvgText> text = document_.attribute(node_, name);
        if (text) {
            text->skip_space();
        }
        return text && text->peek() != '\0' ? text : std::nullopt;
    }

    [[nodiscard]] std::optional<double> length(const char* name, SvgAxis axis) const {
        return svg_length(document_, node_, name, axis, viewport_);
    }

    [[nodiscard]] std::optional<double> given_size(const char* name, SvgAxis axis) const {
        const std::optional<double> number = length(name, axis);
        if (number && !(*number >= 0.0)) {
            document_.fail(node_, std::string(name) + " is below 0");
        }
        return number;
    }

    /// A length that is not below 0; without it, nothing is drawn.
    [[nodiscard]] double size(const char* name, SvgAxis axis) const {
        return given_size(name, axis).value_or(0.0);
    }

    [[nodiscard]] CurvePath read_points() const {
        std::optional<SvgText> points = text("points");
        CurvePath path;
        while (points && points->peek() != '\0') {
            const double x = points->number();
            const Vector2 point{x, points->next_number()};
            if (path.contours().empty()) {
                path.move_to(point);
            } else {
                path.line_to(point);
            }
            points->skip_separator();
        }
        return points ? path.close() : path;
    }

    [[nodiscard]] CurvePath read_rectangle() const {
        const double x = length("x", SvgAxis::x).value_or(0.0);
        const double y = length("y", SvgAxis::y).value_or(0.0);
        const double width = size("width", SvgAxis::x);
        const double height = size("height", SvgAxis::y);
        CurvePath path;
        if (width == 0.0 || height == 0.0) {
            return path;
        }
        // A single radius applies to both axes; neither exceeds half a side.
        const std::optional<double> given_x = length("rx", SvgAxis::x);
        const std::optional<double> given_y = length("ry", SvgAxis::y);
        if (given_x.value_or(0.0) < 0.0 || given_y.value_or(0.0) < 0.0) {
            document_.fail(node_, "a radius of corners is below 0");
        }
        const double rx = std::min(given_x ? *given_x : given_y.value_or(0.0), width / 2.0);
        const double ry = std::min(given_y ? *given_y : given_x.value_or(0.0), height / 2.0);
        const EllipticArc corner{rx, ry};
        path.move_to({x + rx, y}).line_to({x + width - rx, y});
        path.arc_to(corner, {x + width, y + ry}).line_to({x + width, y + height - ry});
        path.arc_to(corner, {x + width - rx, y + height}).line_to({x + rx, y + height});
        path.arc_to(corner, {x, y + height - ry}).line_to({x, y + ry});
        path.arc_to(corner, {x + rx, y});
        return path.close();
    }

    const SvgDocument& document_;
    const pugi::xml_node& node_;
    const std::optional<SvgViewport>& viewport_;
};

}  // namespace

bool is_svg_shape(std::string_view name) {
    return is_one_of(name, {"path", "polygon", "polyline", "rect", "circle", "ellipse"});
}

CurvePath read_svg_shape(const SvgDocument& document, const pugi::xml_node& node,
                         const std::optional<SvgViewport>& viewport) {
    CurvePath path = ShapeReader(document, node, viewport).read(local_name(node));
    if (!path.problem().empty()) {
        document.fail(node, path.problem());
    }
    return path;
}

}  // namespace nearfield::tools
