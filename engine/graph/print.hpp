#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>
#include <nearfield/diagnostics.hpp>

#include <string>

namespace nearfield::graph {

/// Lists passes in order with their barriers and attachments, then resources with lifetimes and
/// memory.
[[nodiscard]] std::string print_text(const Graph& graph, const BakedGraph& baked);

/// The same as a Graphviz digraph with a name: boxes for passes, ellipses for versions of
/// resources.
[[nodiscard]] std::string print_graphviz(const Graph& graph, const BakedGraph& baked,
                                         const std::string& name);

/// In either format, with a title.
[[nodiscard]] std::string print(const Graph& graph, const BakedGraph& baked, GraphFormat format,
                                const std::string& title);

}  // namespace nearfield::graph
