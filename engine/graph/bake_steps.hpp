#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The steps of bake(), in the order in which it takes them.
namespace nearfield::graph {

/// Refuses what is wrong with a resource or a pass taken alone: formats, accesses, attachments.
[[nodiscard]] Status check_declarations(const Graph& graph);

/// Indices of the passes in the order of execution. A reader of a version comes after the pass that
/// produced it and before the pass that replaces it; passes that are free keep the order of
/// declaration. Refuses versions that do not add up, and cycles.
[[nodiscard]] Expected<std::vector<std::uint32_t>> order_passes(const Graph& graph);

/// Fills the lifetimes and gives the images their memory slots. Wants the order.
void find_lifetimes(const Graph& graph, BakedGraph& baked);

/// Puts the barriers before the passes and after the last one. Wants order and lifetimes.
void place_barriers(const Graph& graph, BakedGraph& baked);

/// An error in a graph. Graphs are built by the library itself, so this is never a host's mistake.
[[nodiscard]] inline Status graph_error(std::string message) {
    return {StatusCode::device_error, "graph: " + std::move(message)};
}

}  // namespace nearfield::graph
