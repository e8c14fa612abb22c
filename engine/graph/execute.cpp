#include <engine/base/status_exception.hpp>
#include <engine/graph/access.hpp>
#include <engine/graph/bake_steps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/format.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::graph {

namespace {

VkImageAspectFlags all_aspects(const Resource& resource) {
    return find_format(resource.image.format)->aspects;
}

// The accesses that leave something to make available.
constexpr VkAccessFlags all_writes =
    VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
    VK_ACCESS_HOST_WRITE_BIT | VK_ACCESS_MEMORY_WRITE_BIT;

/// A use outside the graph, as far as the queue's family knows it; a barrier always has stages, so
/// `otherwise` where none are left.
ExternalUse on_queue(ExternalUse use, VkQueueFlags queue, VkPipelineStageFlags otherwise) {
    use.stages = stages_on(use.stages, queue);
    use.access = use.stages == 0 ? 0 : access_on(use.access, queue);
    use.stages = use.stages == 0 ? otherwise : use.stages;
    return use;
}

/// A barrier whose side outside the graph is what the caller stated.
Barrier with_uses(Barrier barrier, const std::optional<ExternalUses>& uses, VkQueueFlags queue) {
    if (uses && barrier.from_outside) {
        const ExternalUse before = on_queue(uses->before, queue, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
        barrier.source_stages = before.stages;
        barrier.source_access = before.access & all_writes;
        barrier.old_layout = before.layout;
    }
    if (uses && barrier.to_outside) {
        const ExternalUse after =
            on_queue(uses->after, queue, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
        barrier.destination_stages = after.stages;
        barrier.destination_access = after.access;
        barrier.new_layout = after.layout;
    }
    return barrier;
}

/// A view for sampling may have one aspect only.
VkImageAspectFlags sampled_aspect(const Resource& resource) {
    constexpr VkImageAspectFlags depth = VK_IMAGE_ASPECT_DEPTH_BIT;
    const VkImageAspectFlags aspects = all_aspects(resource);
    return (aspects & depth) != 0 ? depth : aspects;
}

gpu::Owned<VkImage> make_image(const gpu::Device& device, const ImageDescription& description,
                               VkImageUsageFlags usage) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    if (description.sampled_format != VK_FORMAT_UNDEFINED) {
        info.flags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    }
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = description.format;
    info.extent = {description.extent.width, description.extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    const std::string name = "nearfield image " + description.name;
    return gpu::make_object(device, info, name, name);
}

gpu::Owned<VkImageView> make_view(const gpu::Device& device, VkImage image,
                                  const ImageDescription& description, VkFormat format,
                                  VkImageAspectFlags aspects, const char* purpose) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspects, 0, 1, 0, 1};
    const std::string name = "nearfield image " + description.name + " as " + purpose;
    return gpu::make_object(device, info, name, name);
}

gpu::Owned<VkFramebuffer> make_framebuffer(const gpu::Device& device, VkRenderPass render_pass,
                                           const std::vector<VkImageView>& views, VkExtent2D extent,
                                           const std::string& pass_name) {
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    const std::string name = "nearfield framebuffer " + pass_name;
    return gpu::make_object(device, info, name, name);
}

}  // namespace

Executor::Executor(const gpu::Device& device, const Graph& graph, BakedGraph baked)
    : device_(&device), baked_(std::move(baked)) {
    create_images(graph);
    allocate_memory(graph);
    create_views(graph);
    create_graphics(graph);
    for (const BakedPass& pass : baked_.passes) {
        calls_.push_back(make_call(graph, pass.barriers));
    }
    calls_.push_back(make_call(graph, baked_.to_host));
}

void Executor::create_images(const Graph& graph) {
    images_.resize(graph.resources().size());
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (baked_.lifetimes[i].memory_slot != no_memory_slot) {
            images_[i].image =
                make_image(*device_, graph.resources()[i].image, baked_.lifetimes[i].usage);
        }
    }
}

/// One piece of memory per slot, as large as its largest image; every image starts there.
void Executor::allocate_memory(const Graph& graph) {
    std::vector<VkMemoryRequirements> slots(baked_.memory_slots, {0, 1, ~0U});
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (images_[i].image) {
            VkMemoryRequirements wanted{};
            device_->functions().vkGetImageMemoryRequirements(device_->handle(),
                                                              images_[i].image.get(), &wanted);
            VkMemoryRequirements& slot = slots[baked_.lifetimes[i].memory_slot];
            slot.size = std::max(slot.size, wanted.size);
            slot.alignment = std::max(slot.alignment, wanted.alignment);
            slot.memoryTypeBits &= wanted.memoryTypeBits;
        }
    }
    for (const VkMemoryRequirements& slot : slots) {
        const std::string name = "nearfield image memory " + std::to_string(memory_.size());
        memory_.push_back(device_->memory().allocate(slot, {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT},
                                                     gpu::MemoryKind::image, name));
        image_bytes_ += slot.size;
    }
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (images_[i].image) {
            const gpu::DeviceMemory& memory = memory_[baked_.lifetimes[i].memory_slot];
            gpu::check(
                device_->functions().vkBindImageMemory(device_->handle(), images_[i].image.get(),
                                                       memory.get(), memory.offset()),
                "vkBindImageMemory", "nearfield image " + graph.resources()[i].name());
        }
    }
}

void Executor::create_views(const Graph& graph) {
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const Resource& resource = graph.resources()[i];
        const VkImageUsageFlags usage = baked_.lifetimes[i].usage;
        Image& image = images_[i];
        if (!image.image) {
            continue;  // unused, or the caller's
        }
        if ((usage & ~static_cast<VkImageUsageFlags>(VK_IMAGE_USAGE_SAMPLED_BIT)) != 0) {
            image.attachment_view =
                make_view(*device_, image.image.get(), resource.image, resource.image.format,
                          all_aspects(resource), "attachment");
        }
        if ((usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0) {
            const VkFormat format = resource.image.sampled_format != VK_FORMAT_UNDEFINED
                                        ? resource.image.sampled_format
                                        : resource.image.format;
            image.sampled_view = make_view(*device_, image.image.get(), resource.image, format,
                                           sampled_aspect(resource), "sampled");
        }
    }
}

void Executor::create_graphics(const Graph& graph) {
    graphics_.resize(baked_.passes.size());
    for (std::size_t position = 0; position < graphics_.size(); ++position) {
        const BakedPass& pass = baked_.passes[position];
        if (pass.attachments.empty()) {
            continue;
        }
        std::vector<VkImageView> views;
        for (const Attachment& attachment : pass.attachments) {
            views.push_back(images_[attachment.resource].attachment_view.get());
        }
        GraphicsPass& graphics = graphics_[position];
        graphics.render_pass = make_render_pass(*device_, graph, pass);
        graphics.framebuffer = make_framebuffer(*device_, graphics.render_pass.get(), views,
                                                pass.extent, graph.passes()[pass.pass].name);
    }
}

Executor::BarrierCall Executor::make_call(const Graph& graph,
                                          const std::vector<Barrier>& barriers) const {
    BarrierCall call;
    for (const Barrier& barrier : barriers) {
        const Resource& resource = graph.resources()[barrier.resource];
        // An image barrier makes available only writes through its own image.
        if (barrier.takes_over_memory) {
            call.memory.push_back({.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                   .pNext = nullptr,
                                   .srcAccessMask = barrier.source_access,
                                   .dstAccessMask = barrier.destination_access});
        }
        if (resource.is_image) {
            call.images.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                   .pNext = nullptr,
                                   .srcAccessMask = barrier.source_access,
                                   .dstAccessMask = barrier.destination_access,
                                   .oldLayout = barrier.old_layout,
                                   .newLayout = barrier.new_layout,
                                   .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                   .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                   .image = images_[barrier.resource].image.get(),
                                   .subresourceRange = {all_aspects(resource), 0, 1, 0, 1}});
            call.image_barriers.push_back({barrier, barrier});
        } else {
            call.buffers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                    .pNext = nullptr,
                                    .srcAccessMask = barrier.source_access,
                                    .dstAccessMask = barrier.destination_access,
                                    .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .buffer = VK_NULL_HANDLE,
                                    .offset = 0,
                                    .size = VK_WHOLE_SIZE});
            call.buffer_barriers.push_back({barrier, barrier});
        }
    }
    add_up_stages(call);
    return call;
}

void Executor::add_up_stages(BarrierCall& call) {
    call.source_stages = call.destination_stages = 0;
    for (const auto* const barriers : {&call.image_barriers, &call.buffer_barriers}) {
        for (const PlacedBarrier& placed : *barriers) {
            call.source_stages |= placed.effective.source_stages;
            call.destination_stages |= placed.effective.destination_stages;
        }
    }
}

template <class VulkanBarrier, class Set>
void Executor::set_imported(Handle handle, const std::optional<ExternalUses>& uses,
                            std::vector<VulkanBarrier> BarrierCall::*barriers,
                            std::vector<PlacedBarrier> BarrierCall::*placed, const Set& set) {
    for (BarrierCall& call : calls_) {
        bool changes_stages = false;
        for (std::size_t i = 0; i < (call.*barriers).size(); ++i) {
            PlacedBarrier& one = (call.*placed)[i];
            if (one.declared.resource != handle.resource) {
                continue;
            }
            one.effective = with_uses(one.declared, uses, device_->queue_flags());
            VulkanBarrier& barrier = (call.*barriers)[i];
            barrier.srcAccessMask = one.effective.source_access;
            barrier.dstAccessMask = one.effective.destination_access;
            set(barrier, one.effective);
            changes_stages = true;
        }
        if (changes_stages) {
            add_up_stages(call);
        }
    }
}

void Executor::set_buffer(Handle handle, const ImportedBuffer& imported) {
    set_imported(handle, imported.uses, &BarrierCall::buffers, &BarrierCall::buffer_barriers,
                 [&](VkBufferMemoryBarrier& barrier, const Barrier&) {
                     barrier.buffer = imported.buffer;
                     barrier.offset = imported.offset;
                     barrier.size = imported.size;
                 });
}

void Executor::set_image(Handle handle, const ImportedImage& imported) {
    set_imported(handle, imported.uses, &BarrierCall::images, &BarrierCall::image_barriers,
                 [&](VkImageMemoryBarrier& barrier, const Barrier& effective) {
                     barrier.oldLayout = effective.old_layout;
                     barrier.newLayout = effective.new_layout;
                     barrier.image = imported.image;
                     barrier.subresourceRange.baseMipLevel = imported.level;
                     barrier.subresourceRange.baseArrayLayer = imported.layer;
                 });
}

VkImageView Executor::sampled_view(Handle handle) const {
    return images_[handle.resource].sampled_view.get();
}

void Executor::record_barriers(const Graph& graph, VkCommandBuffer commands,
                               const BarrierCall& call) const {
    for (std::size_t i = 0; i < call.buffers.size(); ++i) {
        if (call.buffers[i].buffer == VK_NULL_HANDLE) {
            throw StatusException(graph_error(
                "buffer '" + graph.resources()[call.buffer_barriers[i].declared.resource].name() +
                "' was not set before the graph was executed"));
        }
    }
    for (std::size_t i = 0; i < call.images.size(); ++i) {
        if (call.images[i].image == VK_NULL_HANDLE) {
            throw StatusException(graph_error(
                "image '" + graph.resources()[call.image_barriers[i].declared.resource].name() +
                "' was not set before the graph was executed"));
        }
    }
    if (call.source_stages == 0) {
        return;
    }
    device_->functions().vkCmdPipelineBarrier(
        commands, call.source_stages, call.destination_stages, 0,
        static_cast<std::uint32_t>(call.memory.size()), call.memory.data(),
        static_cast<std::uint32_t>(call.buffers.size()), call.buffers.data(),
        static_cast<std::uint32_t>(call.images.size()), call.images.data());
}

void Executor::execute(const Graph& graph, VkCommandBuffer commands, gpu::Timestamps& timestamps,
                       const std::function<void(std::size_t, VkCommandBuffer)>& record) const {
    for (std::size_t position = 0; position < baked_.passes.size(); ++position) {
        const BakedPass& baked = baked_.passes[position];
        const Pass& pass = graph.passes()[baked.pass];
        device_->begin_label(commands, pass.name.c_str());
        timestamps.begin(commands, pass.name.c_str());
        record_barriers(graph, commands, calls_[position]);
        if (pass.kind == PassKind::graphics) {
            VkRenderPassBeginInfo info{};
            info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
            info.renderPass = graphics_[position].render_pass.get();
            info.framebuffer = graphics_[position].framebuffer.get();
            info.renderArea.extent = baked.extent;
            device_->functions().vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
            record(baked.pass, commands);
            device_->functions().vkCmdEndRenderPass(commands);
        } else {
            record(baked.pass, commands);
        }
        timestamps.end(commands);
        device_->end_label(commands);
    }
    record_barriers(graph, commands, calls_.back());
}

std::unique_ptr<Executor> make_executor(const gpu::Device& device, const Graph& graph) {
    Expected<BakedGraph> baked = bake(graph, device.queue_flags());
    if (!baked) {
        throw StatusException(baked.error());
    }
    return std::make_unique<Executor>(device, graph, std::move(*baked));
}

}  // namespace nearfield::graph
