#include "screen.hpp"

#include "common/resources.hpp"

#include <algorithm>

namespace nearfield::examples {
namespace {

vk::UniqueRenderPass make_render_pass(vk::Device device) {
    const auto color = vk::AttachmentDescription()
                           .setFormat(Screen::format)
                           .setLoadOp(vk::AttachmentLoadOp::eClear)
                           .setStoreOp(vk::AttachmentStoreOp::eStore)
                           .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
                           .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare)
                           .setFinalLayout(vk::ImageLayout::ePresentSrcKHR);
    const vk::AttachmentReference reference(0, vk::ImageLayout::eColorAttachmentOptimal);
    const auto subpass = vk::SubpassDescription().setColorAttachments(reference);
    // The layout transition waits for the stage in which the submission waits for the image.
    const auto available = vk::SubpassDependency()
                               .setSrcSubpass(VK_SUBPASS_EXTERNAL)
                               .setSrcStageMask(vk::PipelineStageFlagBits::eColorAttachmentOutput)
                               .setDstStageMask(vk::PipelineStageFlagBits::eColorAttachmentOutput)
                               .setDstAccessMask(vk::AccessFlagBits::eColorAttachmentWrite);
    return device.createRenderPassUnique(
        vk::RenderPassCreateInfo().setAttachments(color).setSubpasses(subpass).setDependencies(
            available));
}

vk::UniqueSwapchainKHR make_swapchain(const OwnDevice& device, vk::SurfaceKHR surface,
                                      vk::Extent2D& extent, vk::SwapchainKHR old) {
    const vk::SurfaceCapabilitiesKHR can =
        device.physical_device().getSurfaceCapabilitiesKHR(surface);
    extent.width = std::clamp(extent.width, can.minImageExtent.width, can.maxImageExtent.width);
    extent.height = std::clamp(extent.height, can.minImageExtent.height, can.maxImageExtent.height);
    const std::uint32_t images = std::max(can.minImageCount, 3U);
    return device.device().createSwapchainKHRUnique(
        vk::SwapchainCreateInfoKHR()
            .setSurface(surface)
            .setMinImageCount(can.maxImageCount != 0 ? std::min(images, can.maxImageCount) : images)
            .setImageFormat(Screen::format)
            .setImageColorSpace(vk::ColorSpaceKHR::eSrgbNonlinear)
            .setImageExtent(extent)
            .setImageArrayLayers(1)
            .setImageUsage(vk::ImageUsageFlagBits::eColorAttachment |
                           vk::ImageUsageFlagBits::eTransferSrc)
            .setPreTransform(can.currentTransform)
            .setCompositeAlpha(vk::CompositeAlphaFlagBitsKHR::eOpaque)
            .setPresentMode(vk::PresentModeKHR::eFifo)
            .setClipped(VK_TRUE)
            .setOldSwapchain(old));
}

/// Returns whether the swapchain fits its window; throws on other errors. Without a pointer, calls
/// would throw where it does not.
bool fits(vk::Result result, const char* call) {
    if (result == vk::Result::eErrorOutOfDateKHR) {
        return false;
    }
    if (result != vk::Result::eSuboptimalKHR) {
        vk::resultCheck(result, call);
    }
    return true;
}

}  // namespace

Screen::Screen(const OwnDevice& device, vk::SurfaceKHR surface, vk::Extent2D extent)
    : device_(device), surface_(surface), render_pass_(make_render_pass(device.device())) {
    make_anew(extent);
}

void Screen::make_anew(vk::Extent2D extent) {
    extent_ = extent;
    swapchain_ = make_swapchain(device_, surface_, extent_, *swapchain_);
    const vk::Device device = device_.device();
    images_ = device.getSwapchainImagesKHR(*swapchain_);
    framebuffers_.clear();
    views_.clear();
    drawn_.clear();
    for (const vk::Image image : images_) {
        views_.push_back(make_view(device, image, format, vk::ImageAspectFlagBits::eColor));
        framebuffers_.push_back(device.createFramebufferUnique(vk::FramebufferCreateInfo()
                                                                   .setRenderPass(*render_pass_)
                                                                   .setAttachments(*views_.back())
                                                                   .setWidth(extent_.width)
                                                                   .setHeight(extent_.height)
                                                                   .setLayers(1)));
        drawn_.push_back(device.createSemaphoreUnique({}));
    }
}

std::optional<std::uint32_t> Screen::acquire(vk::Semaphore available) {
    std::uint32_t index = 0;
    const vk::Result result =
        device_.device().acquireNextImageKHR(*swapchain_, UINT64_MAX, available, {}, &index);
    return fits(result, "vkAcquireNextImageKHR") ? std::optional(index) : std::nullopt;
}

void Screen::begin(vk::CommandBuffer commands, std::uint32_t image,
                   const vk::ClearValue& clear) const {
    commands.beginRenderPass(vk::RenderPassBeginInfo()
                                 .setRenderPass(*render_pass_)
                                 .setFramebuffer(*framebuffers_[image])
                                 .setRenderArea({{0, 0}, extent_})
                                 .setClearValues(clear),
                             vk::SubpassContents::eInline);
}

bool Screen::present(std::uint32_t image) {
    const auto info = vk::PresentInfoKHR()
                          .setWaitSemaphores(*drawn_[image])
                          .setSwapchains(*swapchain_)
                          .setImageIndices(image);
    return fits(device_.queue().presentKHR(&info), "vkQueuePresentKHR");
}

}  // namespace nearfield::examples
