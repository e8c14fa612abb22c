#pragma once

#include "common/own_device.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::examples {

/// A swapchain with the framebuffers of its images, recreated when the window changes its size.
class Screen {
public:
    static constexpr vk::Format format = vk::Format::eB8G8R8A8Unorm;

    Screen(const OwnDevice& device, vk::SurfaceKHR surface, vk::Extent2D extent);

    [[nodiscard]] vk::Extent2D extent() const { return extent_; }
    [[nodiscard]] vk::RenderPass render_pass() const { return *render_pass_; }

    /// An image to draw to once `available` is signalled; empty if the swapchain does not fit the
    /// window any more.
    [[nodiscard]] std::optional<std::uint32_t> acquire(vk::Semaphore available);
    /// Begins and ends the render pass, which clears the image.
    void begin(vk::CommandBuffer commands, std::uint32_t image, const vk::ClearValue& clear) const;
    [[nodiscard]] vk::Image image(std::uint32_t index) const { return images_[index]; }
    /// Signalled by the submission that draws the image; present() waits for it.
    [[nodiscard]] vk::Semaphore drawn(std::uint32_t index) const { return *drawn_[index]; }
    /// Returns false if the swapchain does not fit the window any more.
    [[nodiscard]] bool present(std::uint32_t image);

    /// Recreates the swapchain for the window's new size. The old swapchain must not be in use.
    void make_anew(vk::Extent2D extent);

private:
    const OwnDevice& device_;
    vk::SurfaceKHR surface_;
    vk::Extent2D extent_;
    vk::UniqueRenderPass render_pass_;
    vk::UniqueSwapchainKHR swapchain_;
    std::vector<vk::Image> images_;
    std::vector<vk::UniqueImageView> views_;
    std::vector<vk::UniqueFramebuffer> framebuffers_;
    std::vector<vk::UniqueSemaphore> drawn_;
};

}  // namespace nearfield::examples
