#pragma once

#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

#include <initializer_list>

namespace nearfield::passes {

/// Adds a pass that reads resources and draws into a new image, tested against a new image of
/// depths, stencils or both (one without a format: no test). Returns the new version of the former.
[[nodiscard]] graph::Handle add_drawing(TileGraph& graph, const char* name,
                                        std::initializer_list<graph::Read> reads,
                                        graph::ImageDescription image,
                                        graph::ImageDescription tested, TileGraph::Record record);

}  // namespace nearfield::passes
