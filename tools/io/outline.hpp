#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/skipped_parts.hpp>

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The outline in a file: rings as given, or a path whose curves are still to be tessellated.
struct Outline {
    std::string file;
    std::vector<Ring> rings;  ///< empty if there is a path
    /// The number of rings of each polygon; empty if there is a path.
    std::vector<std::uint32_t> part_sizes = {};
    CurvePath path;
    SkippedParts skipped = {};  ///< what else the file holds

    /// True if tessellation deviates from the outline.
    [[nodiscard]] bool curved() const;
};

/// The rings of an outline, ready for a shape.
struct OutlineRings {
    std::vector<Ring> rings;
    double deviation = 0.0;  ///< the maximum distance of the rings from the curves
};

/// The default deviation of tessellated curves, as a fraction of the tolerance.
inline constexpr double usual_deviation = 1.0 / 16.0;

/// The outline of a GeoJSON, WKT, WKB, SVG or SVG path data file. The extension (.geojson, .json,
/// .wkt, .wkb, .svg, .path) says which it is; with any other the first characters do. Hexadecimal
/// WKB may stand in place of WKT or WKB. Throws InputError.
[[nodiscard]] Outline read_outline(const std::string& path);
/// Likewise from a stream, whose first characters say what it is; `name` is for the messages.
[[nodiscard]] Outline read_outline(std::istream& stream, const std::string& name);

/// "FILE: skipped what holds no area: Point (2)"; precondition: something was skipped.
[[nodiscard]] std::string skipped_note(const Outline& outline);

/// The rings of an outline, its curves off by at most `deviation`. Throws InputError.
[[nodiscard]] OutlineRings tessellate_outline(const Outline& outline, double deviation);

}  // namespace nearfield::tools
