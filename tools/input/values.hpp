#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
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

/// A pose in the units of the command line and of scenes.
struct DegreesPose {
    double x = 0.0;
    double y = 0.0;
    double degrees = 0.0;
};

/// "X,Y,DEGREES"
[[nodiscard]] DegreesPose parse_pose(std::string_view text, const std::string& option);

/// "X0,Y0,X1,Y1": the low corner, then the high one.
[[nodiscard]] Rectangle parse_rectangle(std::string_view text, const std::string& option);

/// "X,Y"
[[nodiscard]] Vector2 parse_point(std::string_view text, const std::string& option);

/// Whole turns are taken off in degrees, where that is exact.
[[nodiscard]] Pose to_pose(const DegreesPose& pose);

/// Where a motion ends that starts at an angle: its angle differs from the start's by as much as
/// the degrees do, whole turns included.
[[nodiscard]] Pose to_end_pose(const DegreesPose& end, double start_degrees);

}  // namespace nearfield::tools
