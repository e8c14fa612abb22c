#pragma once

#include <nearfield/curve.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The outline in a file: rings as given, or a path whose curves are still to be tessellated.
struct Outline {
    std::string file;
    std::vector<Ring> rings;  ///< empty if there is a path
    CurvePath path;

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

/// Reads the outline in a GeoJSON, WKT, SVG or SVG path data file. The extension (.geojson, .json,
/// .wkt, .svg, .path) determines the format; with any other extension, the first characters do.
/// Throws InputError.
[[nodiscard]] Outline read_outline(const std::string& path);

/// The rings of an outline, whose curves deviate by at most `deviation`. Throws InputError.
[[nodiscard]] OutlineRings tessellate_outline(const Outline& outline, double deviation);

}  // namespace nearfield::tools
