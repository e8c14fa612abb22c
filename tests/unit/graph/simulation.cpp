#include <tests/unit/graph/simulation.hpp>

#include <map>
#include <optional>
#include <vector>

namespace nearfield::graph::testing {
namespace {

/// The requirements of an access, written independently so that the engine's table is tested too.
struct Need {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
    VkAccessFlags write_access;
    VkImageLayout layout;
};

constexpr VkPipelineStageFlags shaders_of_users = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                                  VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                                  VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;

Need need(Access access) {
    switch (access) {
        case Access::color_attachment:
            return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        case Access::depth_stencil_attachment:
            return {VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        case Access::sampled_in_compute:
            return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        case Access::storage_read_in_compute:
            return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::storage_write_in_compute:
            return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
                    VK_ACCESS_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::storage_read_in_fragment:
            return {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::vertex_buffer:
            return {VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::transfer_write:
            return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::transfer_read:
            return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::storage_image_in_compute:
            return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                    VK_ACCESS_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL};
        case Access::indirect_arguments:
            return {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, VK_ACCESS_INDIRECT_COMMAND_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::written_arguments:
            return {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                    VK_ACCESS_INDIRECT_COMMAND_READ_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::exported_buffer:
            return {shaders_of_users, VK_ACCESS_SHADER_READ_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::exported_image:
            return {shaders_of_users, VK_ACCESS_SHADER_READ_BIT, 0,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    return {};
}

// What Vulkan lets a queue family name that computes and does not draw (the tables "Supported
// pipeline stage flags" and "Supported access types").
constexpr VkPipelineStageFlags compute_stages =
    VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT | VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT |
    VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
    VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT |
    VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
constexpr VkAccessFlags compute_accesses =
    VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_SHADER_READ_BIT |
    VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
    VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT | VK_ACCESS_MEMORY_READ_BIT |
    VK_ACCESS_MEMORY_WRITE_BIT;

bool has(VkQueueFlags queue, VkPipelineStageFlags stages, VkAccessFlags accesses) {
    return (queue & VK_QUEUE_GRAPHICS_BIT) != 0 ||
           ((stages & ~compute_stages) == 0 && (accesses & ~compute_accesses) == 0);
}

/// The part of an access that happens on such a queue.
Need need(Access access, VkQueueFlags queue) {
    Need all = need(access);
    if ((queue & VK_QUEUE_GRAPHICS_BIT) == 0) {
        all.stages &= compute_stages;
        all.access &= compute_accesses;
    }
    return all;
}

/// A past access or layout transition, and the effect of later barriers on it.
struct Event {
    std::uint32_t resource = 0;
    VkPipelineStageFlags stages = 0;  // none for a transition: no later barrier names it directly
    VkAccessFlags write_access = 0;
    bool writes = false;
    bool available = false;
    VkPipelineStageFlags before = 0;                        // it happens before these stages
    std::map<VkPipelineStageFlags, VkAccessFlags> visible;  // by stage bit

    [[nodiscard]] bool is_source_of(const Barrier& barrier) const {
        return stages != 0 && (barrier.source_stages & stages) == stages;
    }
    [[nodiscard]] bool is_before(const Barrier& barrier) const {
        return is_source_of(barrier) || (barrier.source_stages & before) != 0;
    }
    /// Stages order everything before them, but access masks apply to one resource only, unless it
    /// is a memory barrier.
    [[nodiscard]] bool is_accessed_through(const Barrier& barrier) const {
        return resource == barrier.resource || barrier.takes_over_memory;
    }
    void reach(const Barrier& barrier) {
        before |= barrier.destination_stages;
        const bool shows = available && is_accessed_through(barrier);
        for (VkPipelineStageFlags stage = 1; shows && stage != 0; stage <<= 1) {
            if ((barrier.destination_stages & stage) != 0) {
                visible[stage] |= barrier.destination_access;
            }
        }
    }
    void pass(const Barrier& barrier) {
        if (!is_before(barrier)) {
            return;
        }
        if (is_source_of(barrier) && is_accessed_through(barrier) &&
            (barrier.source_access & write_access) == write_access) {
            available = true;
        }
        reach(barrier);
    }
    /// True if all of these stages come after it and see its writes. Writes through another image
    /// cannot be seen; they only need to be ordered before.
    [[nodiscard]] bool is_settled_for(std::uint32_t user, VkPipelineStageFlags wanted,
                                      VkAccessFlags access) const {
        if ((before & wanted) != wanted || (writes && !available)) {
            return false;
        }
        for (VkPipelineStageFlags stage = 1; writes && resource == user && stage != 0;
             stage <<= 1) {
            if ((wanted & stage) != 0) {
                const auto entry = visible.find(stage);
                if (entry == visible.end() || (entry->second & access) != access) {
                    return false;
                }
            }
        }
        return true;
    }
};

const char* hazard(bool wrote, bool writes) {
    if (!wrote) {
        return "write after read";
    }
    return writes ? "write after write" : "read after write";
}

/// The memory that the images of a slot share, or that a buffer has to itself.
struct Memory {
    std::vector<Event> events;
    std::uint32_t owner = UINT32_MAX;
};

class Simulation {
public:
    Simulation(const Graph& graph, const BakedGraph& baked, const Execution& execution)
        : graph_(graph),
          baked_(baked),
          execution_(execution),
          is_owned_(graph.resources().size(), true),
          memory_(baked.memory_slots + graph.resources().size()),
          layouts_(graph.resources().size(), VK_IMAGE_LAYOUT_UNDEFINED) {}

    std::string run() {
        for (int round = 0; round < 2 && breach_.empty(); ++round) {
            versions_.assign(graph_.resources().size(), 0);
            begin_imported();
            for (const BakedPass& pass : baked_.passes) {
                apply(pass.barriers);
                for (const Use& use : graph_.passes()[pass.pass].uses) {
                    access(use, graph_.passes()[pass.pass].name);
                }
            }
            apply(baked_.to_host);
            read_by_host();
            use_afterwards();
        }
        return breach_;
    }

private:
    [[nodiscard]] bool is_image(std::uint32_t resource) const {
        return graph_.resources()[resource].is_image;
    }

    Memory& memory_of(std::uint32_t resource) {
        return memory_[graph_.resources()[resource].imported
                           ? baked_.memory_slots + resource
                           : baked_.lifetimes[resource].memory_slot];
    }

    void expect(bool condition, std::uint32_t resource, const std::string& what) {
        if (!condition && breach_.empty()) {
            breach_ = graph_.resources()[resource].name() + ": " + what;
        }
    }

    /// The owner of an imported resource has waited for the fence of its previous use, except for
    /// the accesses declared as prior.
    void begin_imported() {
        for (std::uint32_t i = 0; i < graph_.resources().size(); ++i) {
            const Resource& resource = graph_.resources()[i];
            if (!resource.imported) {
                continue;
            }
            memory_of(i).events.clear();
            if (resource.outside.before) {
                add_event(i, need(*resource.outside.before, execution_.queue));
            }
        }
    }

    void add_event(std::uint32_t resource, const Need& done) {
        Event event;
        event.resource = resource;
        event.stages = done.stages;
        event.writes = done.write_access != 0;
        event.write_access = done.write_access;
        memory_of(resource).events.push_back(event);
    }

    void use_afterwards() {
        for (std::uint32_t i = 0; i < graph_.resources().size(); ++i) {
            const std::optional<Access> after = graph_.resources()[i].outside.after;
            if (!after || !baked_.lifetimes[i].used) {
                continue;
            }
            const Need wanted = need(*after, execution_.queue);
            expect(!is_image(i) || layouts_[i] == wanted.layout, i,
                   "is exported in another layout");
            if (execution_.read_by_other_family) {
                read_by_other_family(i);
                continue;
            }
            for (const Event& event : memory_of(i).events) {
                expect(!event.writes || event.is_settled_for(i, wanted.stages, wanted.access), i,
                       "is exported with a write that is not to be seen");
            }
        }
    }

    /// A semaphore makes all writes before it available, and visible to the stages that wait.
    void read_by_other_family(std::uint32_t resource) {
        expect(execution_.waits, resource, "is read by a queue that does not wait");
        if (!execution_.concurrent) {
            expect(execution_.transferred, resource, "is read by a family that does not own it");
            is_owned_[resource] = false;
        }
    }

    void apply(const std::vector<Barrier>& barriers) {
        for (const Barrier& barrier : barriers) {
            expect(barrier.source_stages != 0 && barrier.destination_stages != 0, barrier.resource,
                   "a barrier without stages");
            expect(has(execution_.queue, barrier.source_stages | barrier.destination_stages,
                       barrier.source_access | barrier.destination_access),
                   barrier.resource, "a barrier for stages that the queue family does not have");
            Memory& memory = memory_of(barrier.resource);
            const std::vector<Event> former = memory.events;
            for (Event& event : memory.events) {
                event.pass(barrier);
            }
            if (is_image(barrier.resource) && (barrier.old_layout != barrier.new_layout ||
                                               barrier.old_layout == VK_IMAGE_LAYOUT_UNDEFINED)) {
                make_transition(barrier, memory, former);
            }
        }
    }

    void make_transition(const Barrier& barrier, Memory& memory, const std::vector<Event>& former) {
        const std::uint32_t image = barrier.resource;
        for (std::size_t i = 0; i < former.size(); ++i) {
            expect(former[i].is_before(barrier), image, "a transition that does not wait");
            expect(!former[i].writes || memory.events[i].available, image,
                   "a transition over a write that is not available");
        }
        if (barrier.old_layout == VK_IMAGE_LAYOUT_UNDEFINED) {
            expect(versions_[image] == 0, image, "a transition that loses the content");
            memory.owner = image;
        } else {
            expect(layouts_[image] == barrier.old_layout, image,
                   "a transition from a wrong layout");
        }
        layouts_[image] = barrier.new_layout;
        Event transition;
        transition.resource = image;
        transition.writes = true;
        transition.available = true;
        transition.reach(barrier);
        memory.events.push_back(transition);
    }

    void access(const Use& use, const std::string& pass) {
        const std::uint32_t resource = use.handle.resource;
        const Need wanted = need(use.access);
        expect(has(execution_.queue, wanted.stages, wanted.access), resource,
               pass + " does what the queue family cannot do");
        // Without a transfer back the content is lost, which a first write does not mind.
        expect(is_owned_[resource] || use.write, resource,
               pass + " reads what another family owns");
        is_owned_[resource] = true;
        Memory& memory = memory_of(resource);
        expect(versions_[resource] == use.handle.version, resource, pass + " sees another version");
        if (is_image(resource)) {
            expect(memory.owner == resource, resource, pass + " finds another image in the memory");
            expect(layouts_[resource] == wanted.layout, resource, pass + " finds another layout");
        }
        for (const Event& event : memory.events) {
            expect((!event.writes && !use.write) ||
                       event.is_settled_for(resource, wanted.stages, wanted.access),
                   resource, pass + " has a hazard: " + hazard(event.writes, use.write));
        }
        add_event(resource, wanted);
        versions_[resource] += use.write ? 1 : 0;
    }

    void read_by_host() {
        for (std::uint32_t i = 0; i < graph_.resources().size(); ++i) {
            if (!graph_.resources()[i].buffer.read_by_host) {
                continue;
            }
            for (const Event& event : memory_of(i).events) {
                expect(!event.writes || event.is_settled_for(i, VK_PIPELINE_STAGE_HOST_BIT,
                                                             VK_ACCESS_HOST_READ_BIT),
                       i, "the host does not see a write");
            }
        }
    }

    const Graph& graph_;
    const BakedGraph& baked_;
    const Execution execution_;
    std::vector<bool> is_owned_;  // by the family that executes the graph
    std::vector<Memory> memory_;
    std::vector<VkImageLayout> layouts_;
    std::vector<std::uint32_t> versions_;
    std::string breach_;
};

}  // namespace

std::string simulate(const Graph& graph, const BakedGraph& baked, const Execution& execution) {
    return Simulation(graph, baked, execution).run();
}

}  // namespace nearfield::graph::testing
