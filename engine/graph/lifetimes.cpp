#include <engine/graph/access.hpp>
#include <engine/graph/bake_steps.hpp>
#include <engine/graph/format.hpp>

#include <algorithm>

namespace nearfield::graph {

namespace {

/// Memory shared by images with disjoint lifetimes.
struct Slot {
    VkFormat memory_class = VK_FORMAT_UNDEFINED;
    std::uint32_t last = 0;
};

/// Vulkan guarantees images of one class the same memory types whatever their size and usage: all
/// colour formats form one class, and each format with depth or stencil its own. Images of two
/// classes may have no memory type in common, so they share no slot.
VkFormat memory_class(const ImageDescription& image) {
    return find_format(image.format)->is_color() ? VK_FORMAT_UNDEFINED : image.format;
}

void find_uses(const Graph& graph, BakedGraph& baked) {
    baked.lifetimes.resize(graph.resources().size());
    for (std::uint32_t position = 0; position < baked.passes.size(); ++position) {
        for (const Use& use : graph.passes()[baked.passes[position].pass].uses) {
            Lifetime& lifetime = baked.lifetimes[use.handle.resource];
            if (!lifetime.used) {
                lifetime.first = position;
                lifetime.used = true;
            }
            lifetime.last = position;
            lifetime.usage |= traits(use.access).usage;
        }
    }
}

}  // namespace

/// Greedy colouring of intervals; it needs the fewest slots if the intervals are ordered by their
/// start.
void find_lifetimes(const Graph& graph, BakedGraph& baked) {
    find_uses(graph, baked);
    std::vector<std::uint32_t> images;
    for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
        const Resource& resource = graph.resources()[i];
        if (resource.is_image && !resource.imported && baked.lifetimes[i].used) {
            images.push_back(i);
        }
    }
    std::stable_sort(images.begin(), images.end(), [&](std::uint32_t a, std::uint32_t b) {
        return baked.lifetimes[a].first < baked.lifetimes[b].first;
    });
    std::vector<Slot> slots;
    for (const std::uint32_t image : images) {
        Lifetime& lifetime = baked.lifetimes[image];
        const VkFormat wanted = memory_class(graph.resources()[image].image);
        auto slot = std::find_if(slots.begin(), slots.end(), [&](const Slot& candidate) {
            return candidate.memory_class == wanted && candidate.last < lifetime.first;
        });
        if (slot == slots.end()) {
            slot = slots.insert(slots.end(), {wanted, 0});
        }
        slot->last = lifetime.last;
        lifetime.memory_slot = static_cast<std::uint32_t>(slot - slots.begin());
    }
    baked.memory_slots = static_cast<std::uint32_t>(slots.size());
}

}  // namespace nearfield::graph
