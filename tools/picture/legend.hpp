#pragma once

#include <tools/picture/field_layer.hpp>
#include <tools/picture/figure.hpp>
#include <tools/picture/furniture.hpp>

#include <vector>

namespace nearfield::tools {

/// What the symbols of a figure stand for; `field` is null where no field is drawn.
[[nodiscard]] std::vector<LegendEntry> legend_of(const Figure& figure, const FieldScale* field);

}  // namespace nearfield::tools
