#pragma once

#include <engine/graph/graph.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::graph {

/// A dependency placed before a pass or, after the last pass, towards the host.
struct Barrier {
    std::uint32_t resource = 0;
    VkPipelineStageFlags source_stages = 0;
    VkPipelineStageFlags destination_stages = 0;
    VkAccessFlags source_access = 0;
    VkAccessFlags destination_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED;  // images only
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED;  // images only
    /// Another image in the same memory was written last. The source is that other image's write,
    /// so the access masks have to apply to memory in general.
    bool takes_over_memory = false;
    bool from_outside = false;  ///< the source is ExternalAccess::before
    bool to_outside = false;    ///< the destination is ExternalAccess::after
};

/// An attachment of a graphics pass. It stays in the layout of its access throughout the render
/// pass; barriers do the transitions.
struct Attachment {
    std::uint32_t resource = 0;
    Access access{};
    bool load = false;   ///< the former content is needed
    bool store = false;  ///< a later pass reads it
};

struct BakedPass {
    std::uint32_t pass = 0;  ///< index into Graph::passes()
    std::vector<Barrier> barriers;
    std::vector<Attachment> attachments;  // graphics passes: colours in order, then depth-stencil
    VkExtent2D extent{};                  // graphics passes: common extent of the attachments
};

/// The memory slot of resources that need no memory from the graph: buffers, and unused images.
inline constexpr std::uint32_t no_memory_slot = UINT32_MAX;

/// When a transient image is in use, as positions in the order of execution, and its memory.
struct Lifetime {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    bool used = false;
    VkImageUsageFlags usage = 0;
    /// Images with the same slot are never alive at the same time and may share memory.
    std::uint32_t memory_slot = no_memory_slot;
};

/// A graph ready for execution: order, barriers, attachments, lifetimes.
struct BakedGraph {
    std::vector<BakedPass> passes;    // in order of execution
    std::vector<Lifetime> lifetimes;  // by resource
    std::vector<Barrier> to_host;     // after the last pass: to its memory, and its shaders
    std::uint32_t memory_slots = 0;
};

/// The queue family that can execute any graph.
inline constexpr VkQueueFlags universal_queue = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;

/// Bakes a graph for a queue family with these flags: barriers name only stages and accesses that
/// it has. Rejects, naming pass and resource: a cycle; a read of a version that nothing
/// wrote; two passes that write the same version; a read of a version that is not the newest but
/// whose successor's writer comes before (a stale handle); an access that does not fit the kind of
/// resource or pass; a graphics pass where the family does not draw; attachments of different
/// extents; a graphics pass without attachment; a pass that uses one resource twice.
[[nodiscard]] Expected<BakedGraph> bake(const Graph& graph, VkQueueFlags queue = universal_queue);

}  // namespace nearfield::graph
