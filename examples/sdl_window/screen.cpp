#include "screen.hpp"

#include "common/resources.hpp"

#include <algorithm>

namespace nearfield::examples {
namespace {

RenderPass make_render_pass(VkDevice device) {
    VkAttachmentDescription color{};
    color.format = Screen::format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // The layout transition waits for the stage in which the submission waits for the image.
    VkSubpassDependency available{};
    available.srcSubpass = VK_SUBPASS_EXTERNAL;
    available.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    available.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    available.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &available;
    return create<RenderPass>(device, vkCreateRenderPass, info, "vkCreateRenderPass");
}

Swapchain make_swapchain(const OwnDevice& device, VkSurfaceKHR surface, VkExtent2D& extent,
                         VkSwapchainKHR old) {
    VkSurfaceCapabilitiesKHR can{};
    require(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical_device(), surface, &can),
            "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    extent.width = std::clamp(extent.width, can.minImageExtent.width, can.maxImageExtent.width);
    extent.height = std::clamp(extent.height, can.minImageExtent.height, can.maxImageExtent.height);
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface;
    info.minImageCount = std::max(can.minImageCount, 3U);
    if (can.maxImageCount != 0) {
        info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    }
    info.imageFormat = Screen::format;
    info.imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = old;
    return create<Swapchain>(device.device(), vkCreateSwapchainKHR, info, "vkCreateSwapchainKHR");
}

Framebuffer make_framebuffer(VkDevice device, VkRenderPass render_pass, VkImageView view,
                             VkExtent2D extent) {
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    return create<Framebuffer>(device, vkCreateFramebuffer, info, "vkCreateFramebuffer");
}

/// Returns whether the swapchain fits its window; throws on other errors.
bool fits(VkResult result, const char* call) {
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        return false;
    }
    if (result != VK_SUBOPTIMAL_KHR) {
        require(result, call);
    }
    return true;
}

}  // namespace

Semaphore make_semaphore(VkDevice device) {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    return create<Semaphore>(device, vkCreateSemaphore, info, "vkCreateSemaphore");
}

Screen::Screen(const OwnDevice& device, VkSurfaceKHR surface, VkExtent2D extent)
    : device_(device), surface_(surface), render_pass_(make_render_pass(device.device())) {
    make_anew(extent);
}

void Screen::make_anew(VkExtent2D extent) {
    extent_ = extent;
    swapchain_ = make_swapchain(device_, surface_, extent_, swapchain_.get());
    const VkDevice device = device_.device();
    std::uint32_t count = 0;
    require(vkGetSwapchainImagesKHR(device, swapchain_.get(), &count, nullptr),
            "vkGetSwapchainImagesKHR");
    images_.resize(count);
    require(vkGetSwapchainImagesKHR(device, swapchain_.get(), &count, images_.data()),
            "vkGetSwapchainImagesKHR");
    framebuffers_.clear();
    views_.clear();
    drawn_.clear();
    for (VkImage image : images_) {
        views_.push_back(make_view(device, image, format, VK_IMAGE_ASPECT_COLOR_BIT));
        framebuffers_.push_back(
            make_framebuffer(device, render_pass_.get(), views_.back().get(), extent_));
        drawn_.push_back(make_semaphore(device));
    }
}

std::optional<std::uint32_t> Screen::acquire(VkSemaphore available) {
    std::uint32_t index = 0;
    const VkResult result = vkAcquireNextImageKHR(device_.device(), swapchain_.get(), UINT64_MAX,
                                                  available, VK_NULL_HANDLE, &index);
    return fits(result, "vkAcquireNextImageKHR") ? std::optional(index) : std::nullopt;
}

void Screen::begin(VkCommandBuffer commands, std::uint32_t image,
                   const VkClearColorValue& clear) const {
    VkClearValue value{};
    value.color = clear;
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = render_pass_.get();
    info.framebuffer = framebuffers_[image].get();
    info.renderArea.extent = extent_;
    info.clearValueCount = 1;
    info.pClearValues = &value;
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

bool Screen::present(std::uint32_t image) {
    const VkSemaphore drawn = drawn_[image].get();
    const VkSwapchainKHR swapchain = swapchain_.get();
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &image;
    return fits(vkQueuePresentKHR(device_.queue(), &info), "vkQueuePresentKHR");
}

}  // namespace nearfield::examples
