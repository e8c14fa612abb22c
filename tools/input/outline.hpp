#pragma once

#include <nearfield/curve.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// What a file holds: rings as they stand, or a path whose curves are still to be tessellated.
struct Outline {
    std::string file;
    std::vector<Ring> rings;  ///< empty where there is a path
    CurvePath path;

    /// True where tessellation will deviate from it.
    [[nodiscard]] bool curved() const;
};

/// An outline as a shape takes it.
struct OutlineRings {
    std::vector<Ring> rings;
    double deviation = 0.0;  ///< how far they may be off
};

/// The part of the tolerance that the curves of an outline may deviate by, unless told otherwise.
inline constexpr double usual_deviation = 1.0 / 16.0;

/// The outline of a GeoJSON, WKT, SVG or SVG path data file. The extension (.geojson, .json, .wkt,
/// .svg, .path) says which it is; with any other the first characters do. Throws InputError.
[[nodiscard]] Outline read_outline(const std::string& path);

/// The rings of an outline, its curves off by at most `deviation`. Throws InputError.
[[nodiscard]] OutlineRings tessellate_outline(const Outline& outline, double deviation);

}  // namespace nearfield::tools
