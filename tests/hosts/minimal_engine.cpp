#include "minimal_engine.hpp"

#include <cstring>

namespace nearfield::test {
namespace {

using namespace examples;

constexpr VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat depth_format = VK_FORMAT_D16_UNORM;

constexpr VkPipelineStageFlags attachment_stages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                   VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                   VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags attachment_writes =
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags attachment_reads =
    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;

VkAttachmentDescription attachment(VkFormat format, VkAttachmentLoadOp load, VkImageLayout from,
                                   VkImageLayout to) {
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = load;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.initialLayout = from;
    attachment.finalLayout = to;
    return attachment;
}

/// Of the two passes, the first clears the images that the previous frame has copied; the second
/// continues with their contents and leaves both images ready for copying.
RenderPass make_pass(VkDevice device, bool is_first) {
    const VkAttachmentLoadOp load =
        is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    const VkImageLayout color = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkImageLayout depth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkImageLayout copied = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkImageLayout nothing = VK_IMAGE_LAYOUT_UNDEFINED;
    const std::array attachments{
        attachment(color_format, load, is_first ? nothing : color, is_first ? color : copied),
        attachment(depth_format, load, is_first ? nothing : depth, is_first ? depth : copied)};
    const VkAttachmentReference color_reference{0, color};
    const VkAttachmentReference depth_reference{1, depth};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_reference;
    subpass.pDepthStencilAttachment = &depth_reference;
    std::array<VkSubpassDependency, 2> dependencies{};
    dependencies[0].srcSubpass = VK_SUBPASS_EXTERNAL;
    dependencies[0].srcStageMask = attachment_stages | VK_PIPELINE_STAGE_TRANSFER_BIT;
    dependencies[0].srcAccessMask = attachment_writes;
    dependencies[0].dstStageMask = attachment_stages;
    dependencies[0].dstAccessMask = attachment_writes | attachment_reads;
    dependencies[1].dstSubpass = VK_SUBPASS_EXTERNAL;
    dependencies[1].srcStageMask = attachment_stages;
    dependencies[1].srcAccessMask = attachment_writes;
    dependencies[1].dstStageMask = attachment_stages | VK_PIPELINE_STAGE_TRANSFER_BIT;
    dependencies[1].dstAccessMask =
        attachment_writes | attachment_reads | VK_ACCESS_TRANSFER_READ_BIT;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    return create<RenderPass>(device, vkCreateRenderPass, info, "vkCreateRenderPass");
}

Framebuffer make_framebuffer(VkDevice device, VkRenderPass pass, const DeviceImage& color,
                             const DeviceImage& depth, VkExtent2D extent) {
    const std::array views{color.view.get(), depth.view.get()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    return create<Framebuffer>(device, vkCreateFramebuffer, info, "vkCreateFramebuffer");
}

/// A triangle at a different position in each frame.
std::array<Vertex, 3> triangle(std::uint64_t frame, float top, const Color& color) {
    const auto left = static_cast<float>(5 * (frame % 16));
    return {{{left, top, color}, {left + 40.0F, top + 10.0F, color}, {left, top + 50.0F, color}}};
}

}  // namespace

MinimalEngine::MinimalEngine(const HostDevice& host, VkExtent2D extent)
    : host_(host),
      first_pass_(make_pass(host.device, true)),
      second_pass_(make_pass(host.device, false)),
      first_painter_(host.physical_device, host.device, first_pass_.get(), frames_in_flight),
      second_painter_(host.physical_device, host.device, second_pass_.get(), frames_in_flight),
      frames_(host, frames_in_flight) {
    resize(extent);
}

void MinimalEngine::resize(VkExtent2D extent) {
    for (std::uint64_t frame = next_frame_;
         frame-- > 0 && frame + frames_in_flight >= next_frame_;) {
        frames_.wait(frame);
    }
    extent_ = extent;
    const VkPhysicalDevice physical_device = host_.physical_device;
    const VkDevice device = host_.device;
    framebuffer_ = {};
    color_ = DeviceImage(physical_device, device, color_format, extent,
                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                         VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ =
        DeviceImage(physical_device, device, depth_format, extent,
                    VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                    VK_IMAGE_ASPECT_DEPTH_BIT);
    framebuffer_ = make_framebuffer(device, first_pass_.get(), color_, depth_, extent);
    const VkDeviceSize pixels = VkDeviceSize{extent.width} * extent.height;
    for (Slot& slot : slots_) {
        slot.color =
            HostBuffer(physical_device, device, 4 * pixels, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        slot.depth =
            HostBuffer(physical_device, device, 2 * pixels, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    }
}

void MinimalEngine::draw(std::uint64_t frame, const Guest& guest) {
    VkCommandBuffer commands = frames_.begin(frame);
    const auto slot = static_cast<std::uint32_t>(frame % frames_in_flight);
    first_painter_.upload(slot, triangle(frame, 10.0F, {200, 40, 60, 255}));
    second_painter_.upload(slot, triangle(frame, 40.0F, {60, 200, 40, 255}));

    begin(commands, first_pass_.get());
    first_painter_.draw(commands, slot, extent_);
    clear_square(commands, slot);
    vkCmdEndRenderPass(commands);

    guest(commands);

    begin(commands, second_pass_.get());
    second_painter_.draw(commands, slot, extent_);
    clear_square(commands, slot + 8);
    vkCmdEndRenderPass(commands);
    copy(commands, slot_of(frame));
    frames_.submit(frame);
    next_frame_ = frame + 1;
}

EngineFrame MinimalEngine::look_at(std::uint64_t frame) {
    frames_.wait(frame);
    const Slot& slot = slot_of(frame);
    EngineFrame look;
    look.color.resize(slot.color.size / sizeof(std::uint32_t));
    std::memcpy(look.color.data(), slot.color.mapped, slot.color.size);
    look.depth.resize(slot.depth.size / sizeof(std::uint16_t));
    std::memcpy(look.depth.data(), slot.depth.mapped, slot.depth.size);
    return look;
}

void MinimalEngine::begin(VkCommandBuffer commands, VkRenderPass pass) {
    std::array<VkClearValue, 2> clear{};
    clear[0].color = {{0.25F, 0.5F, 0.75F, 1.0F}};
    clear[1].depthStencil.depth = 0.25F;
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = pass;
    info.framebuffer = framebuffer_.get();
    info.renderArea.extent = extent_;
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

/// Clears the depth of a square of 4 x 4 pixels.
void MinimalEngine::clear_square(VkCommandBuffer commands, std::uint32_t at) {
    VkClearAttachment clear{};
    clear.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    clear.clearValue.depthStencil.depth = 0.75F;
    const auto corner = static_cast<std::int32_t>(4 * at);
    const VkClearRect square{{{corner, corner}, {4, 4}}, 0, 1};
    vkCmdClearAttachments(commands, 1, &clear, 1, &square);
}

void MinimalEngine::copy(VkCommandBuffer commands, const Slot& slot) {
    VkBufferImageCopy region{};
    region.imageExtent = {extent_.width, extent_.height, 1};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    vkCmdCopyImageToBuffer(commands, color_.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           slot.color.buffer.get(), 1, &region);
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCmdCopyImageToBuffer(commands, depth_.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           slot.depth.buffer.get(), 1, &region);
    VkMemoryBarrier to_host{};
    to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &to_host, 0, nullptr, 0, nullptr);
}

}  // namespace nearfield::test
