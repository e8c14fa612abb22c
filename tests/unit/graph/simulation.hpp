#pragma once

#include <engine/graph/bake.hpp>
#include <engine/graph/graph.hpp>

#include <string>

namespace nearfield::graph::testing {

/// The queue that executes a graph, and who reads what it exports in between.
struct Execution {
    VkQueueFlags queue = universal_queue;
    /// A queue of another family, which also draws, reads it; the host waits for that before the
    /// next execution. Otherwise later commands of the same queue do.
    bool read_by_other_family = false;
    /// That queue waits for a semaphore, signalled by the submission that executes the graph.
    bool waits = true;
    /// Exported resources are shared by both families (VK_SHARING_MODE_CONCURRENT).
    bool concurrent = false;
    /// If not: ownership is released behind the graph, acquired by the reader, and not given back.
    bool transferred = false;
};

/// Executes a baked graph twice in a row on a model of Vulkan's memory and returns the first
/// violation of its rules; empty if there is none. For every access and layout transition, the
/// model tracks the stages that come after it and the stages where its result is visible. It
/// assumes nothing that no barrier on the same memory guarantees. A violation of order is named
/// after its kind: "read after write", "write after read" or "write after write".
[[nodiscard]] std::string simulate(const Graph& graph, const BakedGraph& baked,
                                   const Execution& execution = {});

}  // namespace nearfield::graph::testing
