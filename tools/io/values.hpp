#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/names.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace nearfield::tools {

// <cctype> classifies characters by locale; the file formats do not.
inline bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
inline bool is_in(std::string_view letters, char c) {
    return letters.find(c) != std::string_view::npos;
}
inline char to_upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// The unit of the coordinates that are read from a file: user units are those of the file.
enum class LengthUnit { user, px, mm, cm, inch, pt, pc };

template <>
inline constexpr auto names<LengthUnit> = std::to_array<NamedValue<LengthUnit>>({
    {"user", LengthUnit::user},
    {"px", LengthUnit::px},
    {"mm", LengthUnit::mm},
    {"cm", LengthUnit::cm},
    {"in", LengthUnit::inch},
    {"pt", LengthUnit::pt},
    {"pc", LengthUnit::pc},
});

/// CSS pixels, of which an inch has 96, in a unit; 1 for user units.
[[nodiscard]] double pixels_per(LengthUnit unit);

/// Likewise in a unit of DXF's $INSUNITS; 0 for a code that is not known.
[[nodiscard]] double pixels_of_insunits(double code);

/// Strict parsing of what stands on the command line: the whole text, finite numbers, nothing
/// before or after but the spaces around the numbers of a list. `option` is for the messages of
/// InputError ("--pose-a").

/// Reads a text that as a whole is one finite number; returns false if it is not.
[[nodiscard]] bool parse_finite(std::string_view text, double& number);

/// A text without the spaces before and after it.
[[nodiscard]] std::string_view without_spaces(std::string_view text);

/// A number greater than zero.
[[nodiscard]] double parse_positive(std::string_view text, const std::string& option);

/// A number other than zero.
[[nodiscard]] double parse_nonzero(std::string_view text, const std::string& option);

/// The range of an integer, both ends included.
struct CountRange {
    std::uint32_t min = 0;
    std::uint32_t max = 0;
};

/// Parses an integer in decimal notation ("250", "1e6"), without a leading plus sign.
[[nodiscard]] std::uint32_t parse_count(std::string_view text, const std::string& option,
                                        CountRange range);

/// The name of a picture: it ends in .png or has no extension (a pipe, a terminal).
[[nodiscard]] std::string parse_png_name(const std::string& text, const std::string& option);

/// A pose in the units of the command line and of scenes.
struct DegreesPose {
    double x = 0.0;
    double y = 0.0;
    double degrees = 0.0;
};

/// The largest magnitude of an angle, 2^33 degrees: from there on neighbouring doubles are more
/// than a millionth of a degree apart.
inline constexpr double largest_degrees = 8589934592.0;
/// Why an angle is refused; empty where it is not.
[[nodiscard]] std::string angle_problem(double degrees);

/// "X,Y,DEGREES"
[[nodiscard]] DegreesPose parse_pose(std::string_view text, const std::string& option);

/// "X0,Y0,X1,Y1": the low corner, then the high one.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& option);

/// "X,Y"
[[nodiscard]] Vector2 parse_point(std::string_view text, const std::string& option);

/// Removes whole turns in degrees, where that is exact.
[[nodiscard]] Pose to_pose(const DegreesPose& pose);

/// The end of a motion that starts at an angle: the difference between the angles is that of the
/// degrees, whole turns included.
[[nodiscard]] Pose to_end_pose(const DegreesPose& end, double start_degrees);

}  // namespace nearfield::tools
