#pragma once

#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/furniture.hpp>

#include <vector>

namespace nearfield::tools {

/// The legend entries of a figure; `field` is null if no field is drawn.
[[nodiscard]] std::vector<LegendEntry> legend_of(const Figure& figure, const FieldScale* field);

}  // namespace nearfield::tools
