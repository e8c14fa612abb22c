#include <tests/unit/gpu/canvas.hpp>

#include <array>
#include <cstring>

namespace nearfield::test_support {

Canvas::Canvas(const gpu::Device& device)
    : device_(&device),
      color_(make_image(VK_FORMAT_R32_UINT,
                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                        VK_IMAGE_ASPECT_COLOR_BIT)),
      depth_stencil_(make_image(device.stencil_format(),
                                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT)),
      pixels_(device, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::Direction::readback, "pixels"),
      submission_(device) {
    make_render_pass();
    make_framebuffer();
    make_layout();
    pixels_.reserve(size * size * sizeof(std::uint32_t));
}

Canvas::Image Canvas::make_image(VkFormat format, VkImageUsageFlags usage,
                                 VkImageAspectFlags aspect) const {
    const gpu::Functions& functions = device_->functions();
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size, size, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    Image result;
    result.image = gpu::make_object(*device_, info, "a canvas", "a canvas");
    VkMemoryRequirements needs{};
    functions.vkGetImageMemoryRequirements(device_->handle(), result.image.get(), &needs);
    result.memory = device_->memory().allocate(needs, {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT},
                                               gpu::MemoryKind::image, "a canvas");
    gpu::check(functions.vkBindImageMemory(device_->handle(), result.image.get(),
                                           result.memory.get(), result.memory.offset()),
               "vkBindImageMemory", "a canvas");

    VkImageViewCreateInfo view_info{};
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = result.image.get();
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = format;
    view_info.subresourceRange = {aspect, 0, 1, 0, 1};
    result.view = gpu::make_object(*device_, view_info, "a canvas", "a canvas");
    return result;
}

void Canvas::make_render_pass() {
    std::array<VkAttachmentDescription, 2> attachments{};
    attachments[0].format = VK_FORMAT_R32_UINT;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    attachments[1].format = device_->stencil_format();
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    for (VkAttachmentDescription& attachment : attachments) {
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    }
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    const std::array<VkSubpassDependency, 1> dependencies{{
        {0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
         VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
         VK_ACCESS_TRANSFER_READ_BIT, 0},
    }};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    render_pass_ = gpu::make_object(*device_, info, "a canvas", "a canvas");
}

void Canvas::make_framebuffer() {
    const std::array<VkImageView, 2> views{color_.view.get(), depth_stencil_.view.get()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass();
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size;
    info.height = size;
    info.layers = 1;
    framebuffer_ = gpu::make_object(*device_, info, "a canvas", "a canvas");
}

void Canvas::make_layout() {
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_ = gpu::make_object(*device_, info, "a canvas", "a canvas");
}

void Canvas::begin_render_pass(VkCommandBuffer commands) const {
    std::array<VkClearValue, 2> clear{};
    clear[1].depthStencil = {1.0F, 0};
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = render_pass();
    info.framebuffer = framebuffer_.get();
    info.renderArea = {{0, 0}, {size, size}};
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    device_->functions().vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(size), static_cast<float>(size),
                              0.0F, 1.0F};
    device_->functions().vkCmdSetViewport(commands, 0, 1, &viewport);
    device_->functions().vkCmdSetScissor(commands, 0, 1, &info.renderArea);
}

void Canvas::copy_to_pixels(VkCommandBuffer commands) const {
    // The library itself never copies images, so its table lacks this entry point.
    const auto copy = reinterpret_cast<PFN_vkCmdCopyImageToBuffer>(
        device_->functions().vkGetDeviceProcAddr(device_->handle(), "vkCmdCopyImageToBuffer"));
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {size, size, 1};
    copy(commands, color_.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels_.handle(), 1,
         &region);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    device_->functions().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                              VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                                              nullptr, 0, nullptr);
}

std::vector<std::uint32_t> Canvas::draw(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBuffer commands = submission_.begin();
    begin_render_pass(commands);
    record(commands);
    device_->functions().vkCmdEndRenderPass(commands);
    copy_to_pixels(commands);
    submission_.submit();
    submission_.wait();
    pixels_.invalidate();
    std::vector<std::uint32_t> pixels(std::size_t{size} * size);
    std::memcpy(pixels.data(), pixels_.data(), pixels.size() * sizeof(std::uint32_t));
    return pixels;
}

}  // namespace nearfield::test_support
