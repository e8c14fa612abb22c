#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::graph {

/// The descriptor sets that the passes of a graph need. Passes share one unless they find different
/// resources at the same binding.
class SetPlan {
public:
    struct Set {
        std::string name;  ///< of the first pass that it is for
        std::vector<Binding> bindings;
    };

    SetPlan() = default;
    explicit SetPlan(const Graph& graph);

    [[nodiscard]] const std::vector<Set>& sets() const { return sets_; }
    /// By position of the pass and number of the set among those that it binds.
    [[nodiscard]] const std::vector<std::vector<std::size_t>>& of_passes() const {
        return of_passes_;
    }

private:
    [[nodiscard]] std::size_t find(const Pass& pass, std::uint32_t number);

    std::vector<Set> sets_;
    std::vector<std::vector<std::size_t>> of_passes_;
};

/// What is behind the imported handles of a graph, and the descriptor sets of its passes, which
/// DescriptorUpdates lets refer to it. Whatever the device may execute at the same time has its
/// own; all can share the graph, which has to stay for as long as they are used. Setting resources
/// and executing allocate nothing.
class BoundResources {
public:
    /// Allocates the sets. Throws StatusException as the driver fails.
    BoundResources(const gpu::Device& device, const ComputeLayout& layout, const Graph& graph,
                   const SetPlan& plan, const Executor& executor);

    /// Says what is behind a handle (nothing of a null handle), or one of the parts that passes
    /// bind. It stays until it is set to something else; the device must not be using these
    /// resources.
    void set(Handle handle, const gpu::BufferPart& part, std::uint32_t number = 0);
    /// A buffer or an image that may have uses of the host's before and after; barriers of such a
    /// buffer are about this part of it, others about all of the buffer.
    void set(Handle handle, const gpu::BufferPart& part, const std::optional<ExternalUses>& uses);
    void set(Handle handle, const ImportedImage& image);
    [[nodiscard]] const gpu::BufferPart& part(Handle handle, std::uint32_t number = 0) const {
        return resources_[handle.resource].parts[number];
    }
    /// By position of the pass in the graph and number among those that it binds.
    [[nodiscard]] VkDescriptorSet set_of(std::size_t pass, std::size_t number) const {
        return sets_[plan_->of_passes()[pass][number]];
    }
    /// By resource: what the barriers of an execution are about.
    [[nodiscard]] std::span<const Imported> imported() const { return imported_; }

private:
    struct Resource {
        std::vector<gpu::BufferPart> parts;  ///< of a buffer
        bool has_changed = false;            ///< since the sets were updated
    };
    friend class DescriptorUpdates;

    void allocate_sets(const gpu::Device& device, const ComputeLayout& layout);

    const Graph* graph_;
    const SetPlan* plan_;
    gpu::Owned<VkDescriptorPool> pool_;
    std::vector<VkDescriptorSet> sets_;  // freed with the pool
    std::vector<Resource> resources_;
    std::vector<Imported> imported_;  // by resource, as these
};

/// Lets the descriptor sets of resources refer to what was set, where that is not what they refer
/// to already, in one call of the driver's. Keeps its memory.
class DescriptorUpdates {
public:
    explicit DescriptorUpdates(const gpu::Device& device) : device_(&device) {}

    /// Forgets what was added.
    void begin() { added_.clear(); }
    /// Before an execution with these resources.
    void add(BoundResources& resources) { added_.push_back(&resources); }
    /// Updates the sets of what was added; the device must not be using them. Throws
    /// StatusException if something that passes bind was never set; then nothing is updated.
    void end();

private:
    /// What a write of a descriptor points to.
    struct Target {
        VkDescriptorBufferInfo buffer{};
        VkDescriptorImageInfo image{};
        VkBufferView texels = VK_NULL_HANDLE;
    };

    void add_writes(const BoundResources& resources);
    void add_writes(const BoundResources& resources, VkDescriptorSet set, const Binding& binding);
    void add_write(VkDescriptorSet set, std::uint32_t binding, const Target& target);

    const gpu::Device* device_;
    std::vector<BoundResources*> added_;
    std::vector<VkWriteDescriptorSet> writes_;
    std::vector<Target> targets_;
};

/// What a pass is recorded into, with what is bound there.
class PassCommands {
public:
    PassCommands(VkCommandBuffer commands, const BoundResources* resources, std::size_t pass)
        : commands_(commands), resources_(resources), pass_(pass) {}

    operator VkCommandBuffer() const { return commands_; }  // NOLINT: what it is, with more

    [[nodiscard]] const gpu::BufferPart& part(Handle handle, std::uint32_t number = 0) const {
        return resources_->part(handle, number);
    }
    /// One of the pass's sets, and the same one of other resources of its graph.
    [[nodiscard]] VkDescriptorSet set(std::size_t number = 0) const {
        return set_of(*resources_, number);
    }
    [[nodiscard]] VkDescriptorSet set_of(const BoundResources& others,
                                         std::size_t number = 0) const {
        return others.set_of(pass_, number);
    }

private:
    VkCommandBuffer commands_;
    const BoundResources* resources_;
    std::size_t pass_;
};

}  // namespace nearfield::graph
