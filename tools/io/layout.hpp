#pragma once

#include <tools/io/scene.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <optional>
#include <vector>

namespace nearfield::tools {

/// What is asked of a layout.
struct LayoutRequest {
    std::vector<QueryRequest> queries = {};  ///< each of all pairs
    bool hits_only = false;                  ///< only results for which is_hit() holds
    OutlineTreatment treatment = {};
    LengthUnit unit = LengthUnit::user;
    /// How far edges may be off curves, those of an offset too. None: usual_deviation of the
    /// tolerances, without one layout_deviation of the longer side of a shape.
    std::optional<double> deviation = {};
};

/// The deviation of curves and offsets in a layout without a tolerance, in longer sides of a shape.
inline constexpr double layout_deviation = 1e-5;

/// A scene of the items in outline files: of SVG those of parse_svg_layout(), of any other file
/// one, at the pose 0. Items of the same name get numbers: "disc", "disc#2". What is wrong with the
/// rings of a shape becomes its problem. Throws InputError for a file that cannot be read, and for
/// a query that needs more than a layout has.
[[nodiscard]] Scene read_layout(std::vector<InputFile> files, const LayoutRequest& request);

}  // namespace nearfield::tools
