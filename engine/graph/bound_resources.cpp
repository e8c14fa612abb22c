#include <engine/base/status_exception.hpp>
#include <engine/graph/access.hpp>
#include <engine/graph/bake_steps.hpp>
#include <engine/graph/bound_resources.hpp>

#include <algorithm>
#include <array>

namespace nearfield::graph {
namespace {

bool is_in(const Binding& binding, std::uint32_t set) {
    return binding.set == every_set || binding.set == set;
}

/// The number of the sets that a pass binds in turn.
std::uint32_t sets_of(const Pass& pass) {
    std::uint32_t count = pass.bindings.empty() ? 0 : 1;
    for (const Binding& binding : pass.bindings) {
        if (binding.set != every_set) {
            count = std::max(count, binding.set + 1);
        }
    }
    return count;
}

const Binding* find_at(const std::vector<Binding>& bindings, std::uint32_t number) {
    const auto found =
        std::find_if(bindings.begin(), bindings.end(),
                     [number](const Binding& binding) { return binding.binding == number; });
    return found == bindings.end() ? nullptr : &*found;
}

gpu::Owned<VkDescriptorPool> make_pool(const gpu::Device& device, std::uint32_t sets) {
    const std::array<VkDescriptorPoolSize, 4> sizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, ComputeLayout::storage_buffers * sets},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, ComputeLayout::sampled_images * sets},
         {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, ComputeLayout::storage_images * sets},
         {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, ComputeLayout::texel_buffers * sets}}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    return gpu::make_object(device, info, "compute passes", "nearfield compute sets");
}

}  // namespace

SetPlan::SetPlan(const Graph& graph) {
    for (const Pass& pass : graph.passes()) {
        std::vector<std::size_t>& own = of_passes_.emplace_back();
        for (std::uint32_t number = 0; number < sets_of(pass); ++number) {
            own.push_back(find(pass, number));
        }
    }
}

/// Adds a pass's bindings to the first set that has nothing else there, or to a new one.
std::size_t SetPlan::find(const Pass& pass, std::uint32_t number) {
    const auto has_room = [&](const Set& set) {
        return std::all_of(pass.bindings.begin(), pass.bindings.end(), [&](const Binding& wanted) {
            const Binding* const there =
                is_in(wanted, number) ? find_at(set.bindings, wanted.binding) : nullptr;
            return there == nullptr ||
                   (there->resource == wanted.resource && there->part == wanted.part);
        });
    };
    auto set = std::find_if(sets_.begin(), sets_.end(), has_room);
    if (set == sets_.end()) {
        sets_.push_back({.name = "nearfield set of " + pass.name, .bindings = {}});
        set = sets_.end() - 1;
    }
    for (const Binding& wanted : pass.bindings) {
        if (is_in(wanted, number) && find_at(set->bindings, wanted.binding) == nullptr) {
            set->bindings.push_back(wanted);
        }
    }
    return static_cast<std::size_t>(set - sets_.begin());
}

BoundResources::BoundResources(const gpu::Device& device, const ComputeLayout& layout,
                               const Graph& graph, const SetPlan& plan, const Executor& executor)
    : graph_(&graph),
      plan_(&plan),
      resources_(graph.resources().size()),
      imported_(graph.resources().size()) {
    for (const SetPlan::Set& set : plan.sets()) {
        for (const Binding& binding : set.bindings) {
            std::vector<gpu::BufferPart>& parts = resources_[binding.resource].parts;
            parts.resize(std::max<std::size_t>(parts.size(), binding.part + 1));
        }
    }
    for (std::uint32_t i = 0; i < resources_.size(); ++i) {
        resources_[i].parts.resize(std::max<std::size_t>(resources_[i].parts.size(), 1));
        imported_[i].image.view = executor.sampled_view({i, 0});
        resources_[i].has_changed = true;
    }
    if (!plan.sets().empty()) {
        allocate_sets(device, layout);
    }
}

void BoundResources::allocate_sets(const gpu::Device& device, const ComputeLayout& layout) {
    const std::vector<SetPlan::Set>& planned = plan_->sets();
    const std::vector<VkDescriptorSetLayout> layouts(planned.size(), layout.set_layout());
    pool_ = make_pool(device, static_cast<std::uint32_t>(planned.size()));
    sets_.resize(planned.size());
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
    info.pSetLayouts = layouts.data();
    gpu::check(device.functions().vkAllocateDescriptorSets(device.handle(), &info, sets_.data()),
               "vkAllocateDescriptorSets", "compute passes");
    for (std::size_t i = 0; i < planned.size(); ++i) {
        device.name_object(VK_OBJECT_TYPE_DESCRIPTOR_SET, sets_[i], planned[i].name);
    }
}

void BoundResources::set(Handle handle, const gpu::BufferPart& part, std::uint32_t number) {
    if (handle == Handle{}) {
        return;
    }
    if (number == 0) {
        imported_[handle.resource].buffer = {part.buffer};
    }
    Resource& resource = resources_[handle.resource];
    if (number < resource.parts.size() && part != resource.parts[number]) {
        resource.parts[number] = part;
        resource.has_changed = true;
    }
}

void BoundResources::set(Handle handle, const gpu::BufferPart& part,
                         const std::optional<ExternalUses>& uses) {
    set(handle, part);
    if (uses) {
        imported_[handle.resource].buffer = {part.buffer, part.offset, part.bytes, uses};
    }
}

void BoundResources::set(Handle handle, const ImportedImage& image) {
    ImportedImage& before = imported_[handle.resource].image;
    if (image.view != before.view || image.identity != before.identity) {
        resources_[handle.resource].has_changed = true;
    }
    before = image;
}

void DescriptorUpdates::end() {
    std::size_t most = 0;
    for (const BoundResources* resources : added_) {
        most += ComputeLayout::bindings * resources->sets_.size();
    }
    writes_.clear();
    targets_.clear();
    targets_.reserve(most);  // writes point to them
    for (const BoundResources* resources : added_) {
        add_writes(*resources);
    }
    if (!writes_.empty()) {
        device_->functions().vkUpdateDescriptorSets(device_->handle(),
                                                    static_cast<std::uint32_t>(writes_.size()),
                                                    writes_.data(), 0, nullptr);
    }
    for (BoundResources* resources : added_) {
        for (BoundResources::Resource& resource : resources->resources_) {
            resource.has_changed = false;
        }
    }
}

void DescriptorUpdates::add_writes(const BoundResources& resources) {
    const std::vector<SetPlan::Set>& planned = resources.plan_->sets();
    for (std::size_t i = 0; i < planned.size(); ++i) {
        for (const Binding& binding : planned[i].bindings) {
            if (resources.resources_[binding.resource].has_changed) {
                add_writes(resources, resources.sets_[i], binding);
            }
        }
    }
}

void DescriptorUpdates::add_writes(const BoundResources& resources, VkDescriptorSet set,
                                   const Binding& binding) {
    const BoundResources::Resource& resource = resources.resources_[binding.resource];
    const Resource& declared = resources.graph_->resources()[binding.resource];
    const gpu::BufferPart& part = resource.parts[binding.part];
    const VkImageView view = resources.imported_[binding.resource].image.view;
    if (declared.is_image ? view == VK_NULL_HANDLE : part.buffer == VK_NULL_HANDLE) {
        throw StatusException(graph_error("'" + declared.name() +
                                          "' was not set before the descriptor sets of the graph "
                                          "were updated"));
    }
    if (declared.is_image) {
        const bool is_sampled =
            ComputeLayout::type_of(binding.binding) == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        add_write(set, binding.binding,
                  {.image = {VK_NULL_HANDLE, view,
                             is_sampled ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                        : VK_IMAGE_LAYOUT_GENERAL}});
        return;
    }
    add_write(set, binding.binding, {.buffer = {part.buffer, part.offset, part.bytes}});
    if (binding.binding < ComputeLayout::texel_buffers && part.texels != VK_NULL_HANDLE) {
        add_write(set, ComputeLayout::first_texels + binding.binding, {.texels = part.texels});
    }
}

void DescriptorUpdates::add_write(VkDescriptorSet set, std::uint32_t binding,
                                  const Target& target) {
    const Target& kept = targets_.emplace_back(target);
    VkWriteDescriptorSet& write = writes_.emplace_back();
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = ComputeLayout::type_of(binding);
    if (write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
        write.pBufferInfo = &kept.buffer;
    } else if (write.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) {
        write.pTexelBufferView = &kept.texels;
    } else {
        write.pImageInfo = &kept.image;
    }
}

}  // namespace nearfield::graph
