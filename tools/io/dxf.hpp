#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/simple_features.hpp>
#include <tools/io/values.hpp>

#include <string>

namespace nearfield::tools {

/// The outlines of a drawing in DXF (text form): LWPOLYLINE and POLYLINE with bulges, LINE, ARC,
/// CIRCLE and whole ELLIPSEs, of model space and of the blocks that INSERTs place. Lines, arcs and
/// open polylines of a block are joined where their ends are no farther apart than 10^-6 of the
/// longer side of what the block holds. Layers, colours and widths do not matter.
///
/// Texts, dimensions, hatches and points are counted in `skipped`; other entities are refused by
/// name, since they may be outlines. With a unit, the header states that of the coordinates; they
/// are read in `unit`. `file` is for the messages of InputError, which give line and column.
[[nodiscard]] CurvePath parse_dxf(const std::string& text, const std::string& file,
                                  SkippedParts& skipped, LengthUnit unit = LengthUnit::user);

}  // namespace nearfield::tools
