#include "minimal_engine.hpp"

#include <cstring>

namespace nearfield::test {
namespace {

using namespace examples;

constexpr auto color_format = vk::Format::eR8G8B8A8Unorm;
constexpr auto depth_format = vk::Format::eD16Unorm;

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

vk::AttachmentDescription attachment(vk::Format format, vk::AttachmentLoadOp load, Layout from,
                                     Layout to) {
    return vk::AttachmentDescription()
        .setFormat(format)
        .setLoadOp(load)
        .setStoreOp(vk::AttachmentStoreOp::eStore)
        .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
        .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare)
        .setInitialLayout(from)
        .setFinalLayout(to);
}

/// Of the two passes, the first clears the images that the previous frame has copied; the second
/// continues with their contents and leaves both images ready for copying.
vk::UniqueRenderPass make_pass(vk::Device device, bool is_first) {
    const auto load = is_first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad;
    constexpr Layout color = Layout::eColorAttachmentOptimal;
    constexpr Layout depth = Layout::eDepthStencilAttachmentOptimal;
    constexpr Layout copied = Layout::eTransferSrcOptimal;
    constexpr Layout nothing = Layout::eUndefined;
    const std::array attachments{
        attachment(color_format, load, is_first ? nothing : color, is_first ? color : copied),
        attachment(depth_format, load, is_first ? nothing : depth, is_first ? depth : copied)};
    const vk::AttachmentReference color_reference(0, color);
    const vk::AttachmentReference depth_reference(1, depth);
    const auto subpass = vk::SubpassDescription()
                             .setColorAttachments(color_reference)
                             .setPDepthStencilAttachment(&depth_reference);
    const vk::PipelineStageFlags stages =
        Stage::eColorAttachmentOutput | Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    const vk::AccessFlags writes =
        Access::eColorAttachmentWrite | Access::eDepthStencilAttachmentWrite;
    const vk::AccessFlags reads =
        Access::eColorAttachmentRead | Access::eDepthStencilAttachmentRead;
    const std::array dependencies{
        vk::SubpassDependency(VK_SUBPASS_EXTERNAL, 0, stages | Stage::eTransfer, stages, writes,
                              writes | reads),
        vk::SubpassDependency(0, VK_SUBPASS_EXTERNAL, stages, stages | Stage::eTransfer, writes,
                              writes | reads | Access::eTransferRead)};
    return device.createRenderPassUnique(vk::RenderPassCreateInfo()
                                             .setAttachments(attachments)
                                             .setSubpasses(subpass)
                                             .setDependencies(dependencies));
}

vk::UniqueFramebuffer make_framebuffer(vk::Device device, vk::RenderPass pass,
                                       const DeviceImage& color, const DeviceImage& depth,
                                       vk::Extent2D extent) {
    const std::array views{*color.view, *depth.view};
    return device.createFramebufferUnique(vk::FramebufferCreateInfo()
                                              .setRenderPass(pass)
                                              .setAttachments(views)
                                              .setWidth(extent.width)
                                              .setHeight(extent.height)
                                              .setLayers(1));
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
      first_painter_(host.physical_device, host.device, *first_pass_, frames_in_flight),
      second_painter_(host.physical_device, host.device, *second_pass_, frames_in_flight),
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
    framebuffer_.reset();
    color_ =
        DeviceImage(physical_device, device, color_format, extent,
                    vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc,
                    vk::ImageAspectFlagBits::eColor);
    depth_ = DeviceImage(
        physical_device, device, depth_format, extent,
        vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc,
        vk::ImageAspectFlagBits::eDepth);
    framebuffer_ = make_framebuffer(device, *first_pass_, color_, depth_, extent);
    const VkDeviceSize pixels = VkDeviceSize{extent.width} * extent.height;
    for (Slot& slot : slots_) {
        slot.color =
            HostBuffer(physical_device, device, 4 * pixels, vk::BufferUsageFlagBits::eTransferDst);
        slot.depth =
            HostBuffer(physical_device, device, 2 * pixels, vk::BufferUsageFlagBits::eTransferDst);
    }
}

void MinimalEngine::draw(std::uint64_t frame, const Guest& guest) {
    VkCommandBuffer commands = frames_.begin(frame);
    const auto slot = static_cast<std::uint32_t>(frame % frames_in_flight);
    first_painter_.upload(slot, triangle(frame, 10.0F, {200, 40, 60, 255}));
    second_painter_.upload(slot, triangle(frame, 40.0F, {60, 200, 40, 255}));

    begin(commands, *first_pass_);
    first_painter_.draw(commands, slot, extent_);
    clear_square(commands, slot);
    vkCmdEndRenderPass(commands);

    guest(commands);

    begin(commands, *second_pass_);
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
    info.framebuffer = *framebuffer_;
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
    vkCmdCopyImageToBuffer(commands, *color_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           *slot.color.buffer, 1, &region);
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCmdCopyImageToBuffer(commands, *depth_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           *slot.depth.buffer, 1, &region);
    VkMemoryBarrier to_host{};
    to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &to_host, 0, nullptr, 0, nullptr);
}

}  // namespace nearfield::test
