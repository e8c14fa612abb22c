#include <nearfield/portable_math.hpp>

#include <tools/io/length_unit.hpp>
#include <tools/io/svg_transform.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
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

}  // namespace nearfield::tools
