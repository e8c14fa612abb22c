#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The steps of bake(), in order of execution.
namespace nearfield::graph {

/// Rejects errors of a single resource or pass: formats, accesses, attachments, passes that the
/// queue family cannot execute.
[[nodiscard]] Status check_declarations(const Graph& graph, VkQueueFlags queue);

/// Indices of the passes in the order of execution. A reader of a version comes after the pass that
/// produced it and before the pass that replaces it; otherwise passes keep the order of
/// declaration. Rejects inconsistent versions and cycles.
[[nodiscard]] Expected<std::vector<std::uint32_t>> order_passes(const Graph& graph);

/// Fills in the lifetimes and assigns memory slots to the images. Requires the order.
void find_lifetimes(const Graph& graph, BakedGraph& baked);

/// Places the barriers before the passes and after the last one, with the stages and accesses of
/// the queue family. Requires order and lifetimes.
void place_barriers(const Graph& graph, VkQueueFlags queue, BakedGraph& baked);

/// An error in a graph. Graphs are built by the library itself, so this is never the host's
/// mistake.
[[nodiscard]] inline Status graph_error(std::string message) {
    return {StatusCode::device_error, "graph: " + std::move(message)};
}

}  // namespace nearfield::graph
