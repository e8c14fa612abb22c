#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Strict parsing of what stands on the command line: the whole text, finite numbers, nothing
/// before or after. `option` is for the messages of InputError ("--pose-a").

/// A number greater than zero.
[[nodiscard]] double parse_positive(std::string_view text, const std::string& option);

/// What a whole number may be, both ends included.
struct CountRange {
    std::uint32_t min = 0;
    std::uint32_t max = 0;
};

/// A whole number in decimal notation ("250", "1e6"), without a leading plus sign.
[[nodiscard]] std::uint32_t parse_count(std::string_view text, const std::string& option,
                                        CountRange range);

/// "X,Y,DEGREES"
[[nodiscard]] Pose parse_pose(std::string_view text, const std::string& option);

/// "X,Y,DEGREES" of where a motion ends that starts at another one (0,0,0 where it is left out):
/// whole turns in between are kept.
[[nodiscard]] Pose parse_end_pose(std::string_view text, const std::optional<std::string>& start,
                                  const std::string& option);

/// "X0,Y0,X1,Y1": the low corner, then the high one.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& option);

/// "X,Y"
[[nodiscard]] Vector2 parse_point(std::string_view text, const std::string& option);

/// A pose of x, y and degrees. Whole turns are taken off in degrees, where that is exact.
[[nodiscard]] Pose pose_from_degrees(double x, double y, double degrees);

/// Where a motion ends that starts at an angle: so much further are its degrees than those of the
/// start, whole turns included.
[[nodiscard]] Pose end_pose_from_degrees(double x, double y, double degrees, double start_degrees);

}  // namespace nearfield::tools
