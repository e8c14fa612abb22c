#include <pugixml.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/svg_path.hpp>
#include <tools/io/svg_text.hpp>
#include <tools/io/svg_transform.hpp>
#include <tools/io/text_file.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace nearfield::tools {
namespace {

using Names = std::initializer_list<std::string_view>;

bool is_one_of(std::string_view name, Names names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The name without the prefix "svg:".
std::string_view local_name(const pugi::xml_node& node) {
    std::string_view name = node.name();
    if (name.starts_with("svg:")) {
        name.remove_prefix(4);
    }
    return name;
}

class SvgReader {
public:
    SvgReader(const std::string& text, const std::string& file) : text_(text), file_(file) {
        // Parses in place and without conversions, so that every name and value has the same offset
        // in the buffer as in the file.
        buffer_ = text;
        const pugi::xml_parse_result result =
            document_.load_buffer_inplace(buffer_.data(), buffer_.size(), pugi::parse_minimal);
        if (!result) {
            fail(static_cast<std::size_t>(result.offset),
                 std::string("not XML: ") + result.description());
        }
    }

    CurvePath read() {
        const pugi::xml_node root = document_.document_element();
        if (local_name(root) != "svg") {
            fail(offset_of(root.name()),
                 "the outermost element is \"" + std::string(root.name()) + "\", not svg");
        }
        if (root.attribute("transform")) {
            fail(root, "a transform of the outermost element is not read");
        }
        if (!is_hidden(root)) {
            read_children(root, svg_to_world, 0);
        }
        if (path_.contours().empty()) {
            fail(root, "has no outline");
        }
        return std::move(path_);
    }

private:
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const {
        throw InputError(text_position(file_, text_, offset) + ": " + reason);
    }

    [[nodiscard]] std::size_t offset_of(const char* in_buffer) const {
        return static_cast<std::size_t>(in_buffer - buffer_.data());
    }

    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& reason) const {
        fail(offset_of(node.name()), std::string(node.name()) + ": " + reason);
    }

    [[nodiscard]] SvgText text_of(const pugi::xml_attribute& attribute) const {
        const std::string_view value = attribute.value();
        // An empty value may be outside the buffer.
        return {value, value.empty() ? offset_of(attribute.name()) : offset_of(value.data()), text_,
                file_};
    }

    void read_children(const pugi::xml_node& parent, const AffineMap& map, int depth) {
        if (depth > deepest) {
            fail(parent, "groups nested too deep");
        }
        for (const pugi::xml_node& node : parent.children()) {
            if (node.type() == pugi::node_element) {
                read_element(node, map, depth);
            }
        }
    }

    void read_element(const pugi::xml_node& node, const AffineMap& outer, int depth) {
        const std::string_view name = local_name(node);
        // Elements that draw nothing, and those of editors.
        if (is_one_of(name, {"title", "desc", "metadata", "defs"}) ||
            name.find(':') != std::string_view::npos || is_hidden(node)) {
            return;
        }
        if (!is_one_of(name, {"g", "path", "polygon", "polyline", "rect", "circle", "ellipse"})) {
            fail(node,
                 "is not read; only path, polygon, polyline, rect, circle, ellipse and g are");
        }
        for (const char* const what : {"clip-path", "mask"}) {
            const std::string_view value = node.attribute(what).value();
            if (!value.empty() && value != "none") {
                fail(node, std::string(what) + " is not read");
            }
        }
        AffineMap map = outer;
        if (const pugi::xml_attribute transform = node.attribute("transform")) {
            SvgText text = text_of(transform);
            map = combine(parse_transform(text), outer);
        }
        if (name == "g") {
            read_children(node, map, depth + 1);
            return;
        }
        CurvePath outline = read_outline(node, name);
        if (!outline.problem().empty()) {
            fail(node, outline.problem());
        }
        path_.append(outline.transform(map));
    }

    /// True for display="none". Other style settings that could change a shape are rejected.
    [[nodiscard]] bool is_hidden(const pugi::xml_node& node) const {
        const std::string_view style = node.attribute("style").value();
        for (const std::string_view property :
             {"transform", "display", "visibility", "clip-path", "mask"}) {
            if (style.find(property) != std::string_view::npos) {
                fail(node, "\"" + std::string(property) + "\" in a style is not read");
            }
        }
        const std::string_view visibility = node.attribute("visibility").value();
        if (!visibility.empty() && visibility != "visible") {
            fail(node, "visibility is not read");
        }
        return std::string_view(node.attribute("display").value()) == "none";
    }

    [[nodiscard]] CurvePath read_outline(const pugi::xml_node& node, std::string_view name) const {
        if (name == "path") {
            SvgText data = required(node, "d");
            return parse_path_data(data);
        }
        if (name == "polygon" || name == "polyline") {
            return read_points(node);
        }
        if (name == "rect") {
            return read_rectangle(node);
        }
        const Vector2 centre{length(node, "cx").value_or(0.0), length(node, "cy").value_or(0.0)};
        CurvePath path;
        if (name == "circle") {
            path.circle(centre, positive(node, "r"));
        } else {
            path.ellipse(centre, positive(node, "rx"), positive(node, "ry"));
        }
        return path;
    }

    [[nodiscard]] SvgText required(const pugi::xml_node& node, const char* name) const {
        const pugi::xml_attribute attribute = node.attribute(name);
        if (!attribute || std::string_view(attribute.value()).empty()) {
            fail(node, std::string("needs the attribute ") + name);
        }
        return text_of(attribute);
    }

    /// A number with no unit other than px.
    [[nodiscard]] std::optional<double> length(const pugi::xml_node& node, const char* name) const {
        if (!node.attribute(name)) {
            return std::nullopt;
        }
        SvgText text = required(node, name);
        text.skip_space();
        const double number = text.number();
        const std::size_t unit = text.position();
        const std::string word = text.word();
        text.skip_space();
        if ((!word.empty() && word != "px") || text.peek() != '\0') {
            text.fail(unit, "a length has no unit here, or px");
        }
        return number;
    }

    [[nodiscard]] double positive(const pugi::xml_node& node, const char* name) const {
        const std::optional<double> number = length(node, name);
        if (!number || !(*number > 0.0)) {
            fail(node, std::string(name) + " has to be above 0");
        }
        return *number;
    }

    [[nodiscard]] CurvePath read_points(const pugi::xml_node& node) const {
        SvgText text = required(node, "points");
        CurvePath path;
        text.skip_space();
        while (text.peek() != '\0') {
            const double x = text.number();
            const Vector2 point{x, text.next_number()};
            if (path.contours().empty()) {
                path.move_to(point);
            } else {
                path.line_to(point);
            }
            text.skip_separator();
        }
        return path.close();
    }

    [[nodiscard]] CurvePath read_rectangle(const pugi::xml_node& node) const {
        const double x = length(node, "x").value_or(0.0);
        const double y = length(node, "y").value_or(0.0);
        const double width = positive(node, "width");
        const double height = positive(node, "height");
        // A single radius applies to both axes; neither exceeds half a side.
        std::optional<double> rx = length(node, "rx");
        std::optional<double> ry = length(node, "ry");
        if (rx.value_or(0.0) < 0.0 || ry.value_or(0.0) < 0.0) {
            fail(node, "a radius of corners is below 0");
        }
        rx = std::min(rx ? *rx : ry.value_or(0.0), width / 2.0);
        ry = std::min(ry ? *ry : length(node, "rx").value_or(0.0), height / 2.0);
        const EllipticArc corner{*rx, *ry};
        CurvePath path;
        path.move_to({x + *rx, y}).line_to({x + width - *rx, y});
        path.arc_to(corner, {x + width, y + *ry}).line_to({x + width, y + height - *ry});
        path.arc_to(corner, {x + width - *rx, y + height}).line_to({x + *rx, y + height});
        path.arc_to(corner, {x, y + height - *ry}).line_to({x, y + *ry});
        path.arc_to(corner, {x + *rx, y});
        return path.close();
    }

    static constexpr int deepest = 1024;  // untrusted input must not exhaust the stack

    const std::string& text_;
    const std::string& file_;
    std::string buffer_;
    pugi::xml_document document_;
    CurvePath path_;
};

}  // namespace

CurvePath parse_svg(const std::string& text, const std::string& file) {
    return SvgReader(text, file).read();
}

}  // namespace nearfield::tools
