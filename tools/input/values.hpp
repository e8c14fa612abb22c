#pragma once

#include <nearfield/shape.hpp>

#include <string>
#include <string_view>

namespace nearfield::tools {

/// Strict parsing of what stands on the command line: the whole text, finite numbers, nothing
/// before or after. `option` is for the messages of InputError ("--pose-a").

/// A number greater than zero.
[[nodiscard]] double parse_positive(std::string_view text, const std::string& option);

/// "X,Y,DEGREES"
[[nodiscard]] Pose parse_pose(std::string_view text, const std::string& option);

/// "X0,Y0,X1,Y1": the low corner, then the high one.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& option);

/// "X,Y"
[[nodiscard]] Vector2 parse_point(std::string_view text, const std::string& option);

/// A pose of x, y and degrees. Whole turns are taken off in degrees, where that is exact.
[[nodiscard]] Pose pose_from_degrees(double x, double y, double degrees);

}  // namespace nearfield::tools
