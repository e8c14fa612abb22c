#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>

#include <string>

namespace nearfield::graph::testing {

/// Executes a baked graph twice in a row on a model of Vulkan's memory and returns the first
/// violation of its rules; empty if there is none. For every access and layout transition, the
/// model tracks the stages that come after it and the stages where its result is visible. It
/// assumes nothing that no barrier on the same memory guarantees. A violation of order is named
/// after its kind: "read after write", "write after read" or "write after write".
[[nodiscard]] std::string simulate(const Graph& graph, const BakedGraph& baked);

}  // namespace nearfield::graph::testing
