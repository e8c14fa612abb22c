#pragma once

#include <nearfield/fill.hpp>

#include <tools/io/outline.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// How the rings of an outline become those of a shape.
struct OutlineTreatment {
    std::optional<FillRule> fill_rule = {};  ///< none: odd-even, and the rings stay as they are
    /// What is no wider than this is dropped, vertices too. None: rings that enclose nothing.
    std::optional<double> clean_width = {};
    /// By how much the region grows, with round corners; negative: shrinks. Last of all.
    std::optional<double> offset = {};
    bool strict = false;  ///< nothing is dropped, so rings that enclose nothing are refused
};

/// The rings of an outline, ready for a shape, and what was dropped.
struct ShapeRings {
    std::vector<Ring> rings;
    /// Of tessellation, fill rule and cleaning together.
    double deviation = 0.0;
    /// "FILE: dropped 1 of 3 rings that enclose nothing: ..."; empty if nothing was dropped.
    std::string note = {};
};

/// True if rings deviate from what is asked, so that a deviation has to be stated.
[[nodiscard]] bool needs_deviation(const Outline& outline, const OutlineTreatment& treatment);

/// The rings of an outline as a shape needs them, its curves and those of an offset off by at most
/// `deviation` together. Rings that the library refuses for another reason, and an outline of which
/// nothing would be left, stay as they are: the library's message lists them. Throws InputError.
[[nodiscard]] ShapeRings make_shape_rings(const Outline& outline, double deviation,
                                          const OutlineTreatment& treatment);

}  // namespace nearfield::tools
