#pragma once

#include <nearfield/fill.hpp>
#include <nearfield/shape.hpp>

#include <tools/io/outline.hpp>

#include <optional>
#include <span>
#include <string>

namespace nearfield::tools {

/// True if each ring of the first list has a counterpart of its own in the second one and the other
/// way around: as many vertices in the same cyclic order, or in the reverse one, each no farther
/// than `distance` from its counterpart along x and along y.
[[nodiscard]] bool are_same_rings(std::span<const Ring> first, std::span<const Ring> second,
                                  double distance);

/// A shape at a place, as far as a tolerance depends on it.
struct PlacedRings {
    std::span<const Ring> rings;
    double deviation = 0.0;
    Vector2 translation;
};

/// The tolerance of a separation or a closest point that states none: its answer is exact, and only
/// what it says of the grid depends on the tolerance. A thousandth of the longest side of the
/// boxes of both shapes, or more where their deviations or the size of their coordinates ask for
/// it.
[[nodiscard]] double usual_tolerance(const PlacedRings& a, const PlacedRings& b);

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
