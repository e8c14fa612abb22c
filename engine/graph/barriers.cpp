#include <engine/graph/access.hpp>
#include <engine/graph/bake_steps.hpp>

#include <algorithm>
#include <optional>

namespace nearfield::graph {

namespace {

/// The earlier accesses to a resource that a later use may have to wait for.
struct History {
    VkPipelineStageFlags write_stages = 0;  // of the last write
    VkAccessFlags write_access = 0;
    VkPipelineStageFlags read_stages = 0;  // of all reads since
    std::uint32_t readers = 0;             // their accesses, one bit each
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool used = false;  // by a pass
};

struct Source {
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
};

/// The source of a barrier before a write. Reads wait for the write before them, so waiting for the
/// reads is enough; that write was made available to them already, and a read leaves nothing to
/// make available: an execution dependency suffices.
Source before_write(const History& history) {
    if (history.read_stages != 0) {
        return {history.read_stages, 0};
    }
    return {history.write_stages, history.write_access};
}

Barrier make_barrier(std::uint32_t resource, Source source, const AccessTraits& access,
                     const History& history) {
    return {.resource = resource,
            .source_stages = source.stages,
            .destination_stages = access.stages,
            .source_access = source.access,
            .destination_access = access.access(),
            .old_layout = history.layout,
            .new_layout = access.layout};
}

/// True of a resource whose last use was before the graph.
bool is_from_outside(const History& history, const Resource& resource) {
    return resource.outside.before.has_value() && !history.used;
}

/// The history that the last use before the graph leaves.
History history_of(const ExternalAccess& outside, VkQueueFlags queue) {
    History history;
    if (outside.before) {
        const AccessTraits former = traits(*outside.before, queue);
        if (former.writes) {
            history.write_stages = former.stages;
            history.write_access = former.write_access;
        } else {
            history.read_stages = former.stages;
        }
    }
    return history;
}

/// The barrier that a write needs, if any. The first use of an image is a write; it always needs a
/// barrier for the layout, whose source is filled in later, when all histories are known. The first
/// write of a buffer needs none: the buffer's owner has waited for the fence of its former use.
std::optional<Barrier> write(History& history, std::uint32_t resource, const AccessTraits& wanted) {
    const Source source = before_write(history);
    const Barrier barrier = make_barrier(resource, source, wanted, history);
    history = {.write_stages = wanted.stages,
               .write_access = wanted.write_access,
               .layout = wanted.layout,
               .used = true};
    if (source.stages == 0 && !wanted.of_image) {
        return std::nullopt;
    }
    return barrier;
}

/// The barrier that a read needs, if any. None if an earlier read of the same kind has waited for
/// the write. None if there was no write: then the host wrote the buffer, and vkQueueSubmit makes
/// earlier host writes visible to all the commands it submits.
std::optional<Barrier> read(History& history, std::uint32_t resource, Access access,
                            const AccessTraits& wanted) {
    const std::uint32_t reader = 1U << static_cast<std::uint32_t>(access);
    const bool synchronised = (history.readers & reader) != 0 || history.write_stages == 0;
    const Barrier barrier =
        make_barrier(resource, {history.write_stages, history.write_access}, wanted, history);
    history.readers |= reader;
    history.read_stages |= wanted.stages;
    history.layout = wanted.layout;
    history.used = true;
    if (synchronised) {
        return std::nullopt;
    }
    return barrier;
}

/// Makes the first use of an image wait for the last use of its memory: by the image before it in
/// the slot or, for the slot's first image, by the slot's last image in the previous execution,
/// which may still be running. The content is not needed, so the old layout stays undefined.
void wait_for_memory(BakedGraph& baked, const std::vector<History>& histories,
                     const std::vector<std::uint32_t>& images_in_slot) {
    std::uint32_t former = images_in_slot.back();
    for (const std::uint32_t image : images_in_slot) {
        std::vector<Barrier>& barriers = baked.passes[baked.lifetimes[image].first].barriers;
        const auto barrier =
            std::find_if(barriers.begin(), barriers.end(),
                         [image](const Barrier& other) { return other.resource == image; });
        Source source = before_write(histories[former]);
        barrier->takes_over_memory = former != image && source.access != 0;
        // The image's own last write, in the previous execution, was made available when the next
        // image took over the memory. The validation layer 1.3.239 loses track of that across the
        // chain of barriers unless the write is named here as well.
        if (const Source own = before_write(histories[image]); own.access != 0) {
            source.stages |= own.stages;
            source.access |= own.access;
        }
        barrier->source_stages = source.stages;
        barrier->source_access = source.access;
        former = image;
    }
}

}  // namespace

void place_barriers(const Graph& graph, VkQueueFlags queue, BakedGraph& baked) {
    std::vector<History> histories;
    for (const Resource& resource : graph.resources()) {
        histories.push_back(history_of(resource.outside, queue));
    }
    std::vector<std::vector<std::uint32_t>> images_in_slot(baked.memory_slots);
    for (std::uint32_t position = 0; position < baked.passes.size(); ++position) {
        BakedPass& pass = baked.passes[position];
        for (const Use& use : graph.passes()[pass.pass].uses) {
            const std::uint32_t resource = use.handle.resource;
            const Lifetime& lifetime = baked.lifetimes[resource];
            if (lifetime.memory_slot != no_memory_slot && lifetime.first == position) {
                images_in_slot[lifetime.memory_slot].push_back(resource);
            }
            const bool from_outside =
                is_from_outside(histories[resource], graph.resources()[resource]);
            const AccessTraits wanted = traits(use.access, queue);
            std::optional<Barrier> barrier =
                use.write ? write(histories[resource], resource, wanted)
                          : read(histories[resource], resource, use.access, wanted);
            if (barrier) {
                barrier->from_outside = from_outside;
                pass.barriers.push_back(*barrier);
            }
        }
    }
    for (const std::vector<std::uint32_t>& images : images_in_slot) {
        wait_for_memory(baked, histories, images);
    }
    for (std::uint32_t resource = 0; resource < histories.size(); ++resource) {
        const History& history = histories[resource];
        const std::optional<Access> after = graph.resources()[resource].outside.after;
        if (after && baked.lifetimes[resource].used) {
            baked.to_host.push_back(
                make_barrier(resource, before_write(history), traits(*after, queue), history));
            baked.to_host.back().to_outside = true;
        }
        if (graph.resources()[resource].buffer.read_by_host && history.write_stages != 0) {
            baked.to_host.push_back({.resource = resource,
                                     .source_stages = history.write_stages,
                                     .destination_stages = VK_PIPELINE_STAGE_HOST_BIT,
                                     .source_access = history.write_access,
                                     .destination_access = VK_ACCESS_HOST_READ_BIT});
        }
    }
}

}  // namespace nearfield::graph
