#pragma once

#include <nearfield/shape.hpp>

#include <vector>

namespace nearfield::simulation {

/// An item to be cut from a strip: its outer boundary, then its holes, about the origin.
using NestItem = std::vector<Ring>;

/// Items of eight kinds, most of them not convex and some with holes, the larger ones first.
[[nodiscard]] std::vector<NestItem> nest_items();

}  // namespace nearfield::simulation
