#include <tools/io/svg_path.hpp>
#include <tools/io/values.hpp>

#include <numbers>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

bool is_one_of(char c, std::string_view set) {
    return c != '\0' && set.find(c) != std::string_view::npos;
}

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
        if (!is_one_of(command, "MmLlHhVvCcSsQqTtAaZz")) {
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
        return is_one_of(previous_, commands)
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

}  // namespace nearfield::tools
