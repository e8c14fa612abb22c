#include <engine/base/status_exception.hpp>
#include <engine/gpu/image.hpp>
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
    std::size_t most = baked_.to_host.size();
    for (const BakedPass& pass : baked_.passes) {
        most = std::max(most, pass.barriers.size());
    }
    memory_barriers_.reserve(most);
    image_barriers_.reserve(most);
    buffer_barriers_.reserve(most);
}

void Executor::create_images(const Graph& graph) {
    images_.resize(graph.resources().size());
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (baked_.lifetimes[i].memory_slot != no_memory_slot) {
            const ImageDescription& image = graph.resources()[i].image;
            const bool is_sampled_differently = image.sampled_format != VK_FORMAT_UNDEFINED;
            images_[i].image =
                gpu::make_image(*device_, image.format, image.extent, baked_.lifetimes[i].usage,
                                "nearfield image " + image.name,
                                is_sampled_differently ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0);
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
        const std::string name = "nearfield image " + resource.name() + " as ";
        if ((usage & ~static_cast<VkImageUsageFlags>(VK_IMAGE_USAGE_SAMPLED_BIT)) != 0) {
            image.attachment_view =
                gpu::make_view(*device_, image.image.get(), resource.image.format,
                               all_aspects(resource), name + "attachment");
        }
        if ((usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0) {
            const VkFormat format = resource.image.sampled_format != VK_FORMAT_UNDEFINED
                                        ? resource.image.sampled_format
                                        : resource.image.format;
            image.sampled_view = gpu::make_view(*device_, image.image.get(), format,
                                                sampled_aspect(resource), name + "sampled");
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

VkImageView Executor::sampled_view(Handle handle) const {
    return images_[handle.resource].sampled_view.get();
}

void Executor::add(const Resource& resource, const Imported& imported, const Barrier& declared) {
    const VkImage own = images_[declared.resource].image.get();
    const VkImage image = own != VK_NULL_HANDLE ? own : imported.image.image;
    if (resource.is_image ? image == VK_NULL_HANDLE : imported.buffer.buffer == VK_NULL_HANDLE) {
        throw StatusException(graph_error((resource.is_image ? "image '" : "buffer '") +
                                          resource.name() +
                                          "' was not set before the graph was executed"));
    }
    const Barrier barrier =
        with_uses(declared, resource.is_image ? imported.image.uses : imported.buffer.uses,
                  device_->queue_flags());
    // An image barrier makes available only writes through its own image.
    if (barrier.takes_over_memory) {
        memory_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                    .pNext = nullptr,
                                    .srcAccessMask = barrier.source_access,
                                    .dstAccessMask = barrier.destination_access});
    }
    if (resource.is_image) {
        image_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                   .pNext = nullptr,
                                   .srcAccessMask = barrier.source_access,
                                   .dstAccessMask = barrier.destination_access,
                                   .oldLayout = barrier.old_layout,
                                   .newLayout = barrier.new_layout,
                                   .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                   .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                   .image = image,
                                   .subresourceRange = {all_aspects(resource), imported.image.level,
                                                        1, imported.image.layer, 1}});
    } else {
        buffer_barriers_.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                    .pNext = nullptr,
                                    .srcAccessMask = barrier.source_access,
                                    .dstAccessMask = barrier.destination_access,
                                    .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                    .buffer = imported.buffer.buffer,
                                    .offset = imported.buffer.offset,
                                    .size = imported.buffer.size});
    }
    source_stages_ |= barrier.source_stages;
    destination_stages_ |= barrier.destination_stages;
}

void Executor::record_barriers(const Graph& graph, std::span<const Imported> imported,
                               VkCommandBuffer commands, const std::vector<Barrier>& barriers) {
    if (barriers.empty()) {
        return;
    }
    memory_barriers_.clear();
    image_barriers_.clear();
    buffer_barriers_.clear();
    source_stages_ = destination_stages_ = 0;
    for (const Barrier& barrier : barriers) {
        add(graph.resources()[barrier.resource], imported[barrier.resource], barrier);
    }
    device_->functions().vkCmdPipelineBarrier(
        commands, source_stages_, destination_stages_, 0,
        static_cast<std::uint32_t>(memory_barriers_.size()), memory_barriers_.data(),
        static_cast<std::uint32_t>(buffer_barriers_.size()), buffer_barriers_.data(),
        static_cast<std::uint32_t>(image_barriers_.size()), image_barriers_.data());
}

void Executor::execute(const Graph& graph, std::span<const Imported> imported,
                       VkCommandBuffer commands, gpu::Timestamps& timestamps,
                       FunctionRef<void(std::size_t, VkCommandBuffer)> record) {
    for (std::size_t position = 0; position < baked_.passes.size(); ++position) {
        const BakedPass& baked = baked_.passes[position];
        const Pass& pass = graph.passes()[baked.pass];
        device_->begin_label(commands, pass.name.c_str());
        timestamps.begin(commands, pass.name.c_str());
        record_barriers(graph, imported, commands, baked.barriers);
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
    record_barriers(graph, imported, commands, baked_.to_host);
}

std::unique_ptr<Executor> make_executor(const gpu::Device& device, const Graph& graph) {
    Expected<BakedGraph> baked = bake(graph, device.queue_flags());
    if (!baked) {
        throw StatusException(baked.error());
    }
    return std::make_unique<Executor>(device, graph, std::move(*baked));
}

}  // namespace nearfield::graph
