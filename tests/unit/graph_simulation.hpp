#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>

#include <string>

namespace nearfield::graph::testing {

/// Executes a baked graph twice in a row on a model of Vulkan's memory and returns the first breach
/// of its rules; empty where there is none. The model knows, of every access and layout transition,
/// which stages come after it and where its result can be seen. It takes nothing for granted that
/// no barrier on the same memory says. A breach of order is called after its kind: "read after
/// write", "write after read" or "write after write".
[[nodiscard]] std::string simulate(const Graph& graph, const BakedGraph& baked);

}  // namespace nearfield::graph::testing
