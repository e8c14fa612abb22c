#pragma once

#include "common/own_device.hpp"
#include "common/resources.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::examples {

/// A swapchain with the framebuffers of its images, recreated when the window changes its size.
class Screen {
public:
    static constexpr VkFormat format = VK_FORMAT_B8G8R8A8_UNORM;

    Screen(const OwnDevice& device, VkSurfaceKHR surface, VkExtent2D extent);

    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    [[nodiscard]] VkRenderPass render_pass() const { return render_pass_.get(); }

    /// An image to draw to once `available` is signalled; empty if the swapchain does not fit the
    /// window any more.
    [[nodiscard]] std::optional<std::uint32_t> acquire(VkSemaphore available);
    /// Begins and ends the render pass, which clears the image.
    void begin(VkCommandBuffer commands, std::uint32_t image, const VkClearColorValue& clear) const;
    [[nodiscard]] VkImage image(std::uint32_t index) const { return images_[index]; }
    /// Signalled by the submission that draws the image; present() waits for it.
    [[nodiscard]] VkSemaphore drawn(std::uint32_t index) const { return drawn_[index].get(); }
    /// Returns false if the swapchain does not fit the window any more.
    [[nodiscard]] bool present(std::uint32_t image);

    /// Recreates the swapchain for the window's new size. The old swapchain must not be in use.
    void make_anew(VkExtent2D extent);

private:
    const OwnDevice& device_;
    VkSurfaceKHR surface_;
    VkExtent2D extent_{};
    RenderPass render_pass_;
    Swapchain swapchain_;
    std::vector<VkImage> images_;
    std::vector<ImageView> views_;
    std::vector<Framebuffer> framebuffers_;
    std::vector<Semaphore> drawn_;
};

[[nodiscard]] Semaphore make_semaphore(VkDevice device);

}  // namespace nearfield::examples
