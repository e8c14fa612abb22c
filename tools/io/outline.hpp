#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/simple_features.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The outline in a file: rings as given, or a path whose curves are still to be tessellated.
struct Outline {
    std::string file;
    std::vector<Ring> rings = {};  ///< empty if there is a path
    /// The number of rings of each polygon; empty if there is a path.
    std::vector<std::uint32_t> part_sizes = {};
    CurvePath path = {};
    /// Of SVG: the contours of the path that each element draws, with its fill rule.
    std::vector<FilledPart> parts = {};
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

/// What a file holds.
enum class OutlineFormat { geojson, wkt, hex_wkb, binary_wkb, svg, path, dxf };

/// The format of a file. The extension (.geojson, .json, .wkt, .wkb, .svg, .path, .dxf) says which
/// it is; with any other the first characters do. Hexadecimal WKB may stand in place of WKT or WKB.
/// Throws InputError.
[[nodiscard]] OutlineFormat format_of(const InputFile& file);

/// The outline in a file. `unit` is for files that state what a length is. Throws InputError.
[[nodiscard]] Outline parse_outline(InputFile file, LengthUnit unit = LengthUnit::user);
/// Likewise; "-" reads the standard input.
[[nodiscard]] Outline read_outline(const std::string& path, LengthUnit unit = LengthUnit::user);

/// "FILE: skipped what holds no area: Point (2)", of SVG "what has no outline"; precondition:
/// something was skipped.
[[nodiscard]] std::string skipped_note(const Outline& outline);

/// The rings of an outline, its curves off by at most `deviation`. Throws InputError.
[[nodiscard]] OutlineRings tessellate_outline(const Outline& outline, double deviation);

}  // namespace nearfield::tools
