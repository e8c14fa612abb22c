#include <tools/io/svg_path.hpp>
#include <tools/io/svg_shapes.hpp>

#include <algorithm>
#include <string>

namespace nearfield::tools {
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
