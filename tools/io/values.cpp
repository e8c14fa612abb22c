#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <span>
#include <system_error>

namespace nearfield::tools {

double pixels_per(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::mm:
            return 96.0 / 25.4;
        case LengthUnit::cm:
            return 96.0 / 2.54;
        case LengthUnit::inch:
            return 96.0;
        case LengthUnit::pt:
            return 96.0 / 72.0;
        case LengthUnit::pc:
            return 16.0;
        case LengthUnit::user:
        case LengthUnit::px:
            break;
    }
    return 1.0;
}

double pixels_of_insunits(double code) {
    constexpr double inch = 96.0;
    constexpr double metre = 1000.0 / 25.4 * inch;
    constexpr std::array<double, 15> lengths{
        0.0,          inch,          12.0 * inch,  63360.0 * inch, 1e-3 * metre,
        1e-2 * metre, metre,         1e3 * metre,  1e-6 * inch,    1e-3 * inch,
        36.0 * inch,  1e-10 * metre, 1e-9 * metre, 1e-6 * metre,   1e-1 * metre};
    const bool is_known = code > 0.0 && code < static_cast<double>(lengths.size());
    return is_known ? lengths[static_cast<std::size_t>(code)] : 0.0;
}

bool parse_finite(std::string_view text, double& number) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
        text.remove_prefix(1);
    }
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && rest == end && std::isfinite(number);
}

std::string_view without_spaces(std::string_view text) {
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

namespace {

[[noreturn]] void fail(const std::string& option, std::string_view text,
                       const std::string& reason) {
    throw InputError(option + ": \"" + std::string(text) + "\": " + reason);
}

/// Finite numbers separated by commas, with or without spaces around them; `form` says what they
/// are.
void parse_list(std::string_view text, const std::string& option, const std::string& form,
                std::span<double> numbers) {
    std::string_view rest = text;
    for (std::size_t index = 0; index < numbers.size(); ++index) {
        const bool last = index + 1 == numbers.size();
        const std::size_t comma = last ? rest.size() : rest.find(',');
        if (comma == std::string_view::npos) {
            fail(option, text, "expected " + form);
        }
        const std::string_view part = without_spaces(rest.substr(0, comma));
        if (!parse_finite(part, numbers[index])) {
            fail(option, text,
                 "expected " + form + "; \"" + std::string(part) + "\" is not a finite number");
        }
        rest.remove_prefix(last ? comma : comma + 1);
    }
}

}  // namespace

double parse_positive(std::string_view text, const std::string& option) {
    double number = 0.0;
    if (!parse_finite(text, number) || !(number > 0.0)) {
        fail(option, text, "expected a finite number greater than 0");
    }
    return number;
}

double parse_nonzero(std::string_view text, const std::string& option) {
    double number = 0.0;
    if (!parse_finite(text, number) || number == 0.0) {
        fail(option, text, "expected a finite number other than 0");
    }
    return number;
}

std::string parse_png_name(const std::string& text, const std::string& option) {
    const std::string extension = lower_case_extension(text);
    if (!extension.empty() && extension != ".png") {
        fail(option, text, "pictures are written as PNG files, whose names end in .png");
    }
    return text;
}

std::uint32_t parse_count(std::string_view text, const std::string& option, CountRange range) {
    const auto refuse = [&](const std::string& reason) {
        throw InputError(option + ": \"" + std::string(text) + "\" is " + reason);
    };
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    const bool too_large = error == std::errc::result_out_of_range;
    const bool whole = too_large || (std::isfinite(number) && number == std::floor(number));
    if (error == std::errc::invalid_argument || rest != end || !whole) {
        refuse("not a whole number in decimal notation");
    }
    if (too_large || std::signbit(number) || number < range.min || number > range.max) {
        refuse("out of range " + std::to_string(range.min) + " to " + std::to_string(range.max));
    }
    return static_cast<std::uint32_t>(number);
}

std::string angle_problem(double degrees) {
    if (std::abs(degrees) <= largest_degrees) {
        return {};
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "an angle of %g degrees is too large to mean anything: it is known to no better "
                  "than %.1g degrees; the largest is %.0f",
                  degrees, std::nextafter(std::abs(degrees), HUGE_VAL) - std::abs(degrees),
                  largest_degrees);
    return text;
}

DegreesPose parse_pose(std::string_view text, const std::string& option) {
    double numbers[3] = {};
    parse_list(text, option, "X,Y,DEGREES (three numbers)", numbers);
    if (const std::string problem = angle_problem(numbers[2]); !problem.empty()) {
        fail(option, text, problem);
    }
    return {numbers[0], numbers[1], numbers[2]};
}

Pose to_pose(const DegreesPose& pose) {
    const double turn = std::remainder(pose.degrees, 360.0);
    return {{pose.x, pose.y}, turn * (std::numbers::pi / 180.0)};
}

Pose to_end_pose(const DegreesPose& end, double start_degrees) {
    const double start = to_pose({.degrees = start_degrees}).angle;
    return {{end.x, end.y}, start + (end.degrees - start_degrees) * (std::numbers::pi / 180.0)};
}

Vector2 parse_point(std::string_view text, const std::string& option) {
    double numbers[2] = {};
    parse_list(text, option, "X,Y (two numbers)", numbers);
    return {numbers[0], numbers[1]};
}

Rectangle parse_rectangle(std::string_view text, const std::string& option) {
    double numbers[4] = {};
    parse_list(text, option, "X0,Y0,X1,Y1 (four numbers)", numbers);
    if (!(numbers[0] < numbers[2] && numbers[1] < numbers[3])) {
        fail(option, text, "expected X0 < X1 and Y0 < Y1");
    }
    return {{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
}

}  // namespace nearfield::tools
