#pragma once

#include <tools/rendering/page.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::viewer {

/// Paints a window: a page copied to the images of a swapchain, with two frames in flight.
class Screen {
public:
    Screen(const tools::Gpu& gpu, vk::SurfaceKHR surface, vk::Extent2D extent,
           const tools::Letters& letters);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// Paints a mesh to a window with the given non-zero size. Returns false if the window changed
    /// in the meantime and nothing was shown.
    bool show(const tools::Mesh& mesh);
    /// The last picture that was shown.
    [[nodiscard]] tools::FrameImage picture();

private:
    static constexpr std::uint32_t frames_in_flight = 2;

    struct Frame {
        explicit Frame(const tools::Gpu& gpu);
        tools::Commands commands;
        vk::raii::Semaphore available;  // the image of the swapchain
    };

    void fit(vk::Extent2D extent);
    void record(const vk::raii::CommandBuffer& commands, std::uint32_t image,
                const tools::Mesh& mesh);
    [[nodiscard]] bool present(std::uint32_t image);

    const tools::Gpu& gpu_;
    vk::SurfaceKHR surface_;
    tools::VulkanPainter painter_;
    std::optional<tools::PaintedPage> page_;
    vk::raii::SwapchainKHR swapchain_{nullptr};
    vk::Extent2D extent_;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::Semaphore> painted_;  // one per image
    std::array<Frame, frames_in_flight> frames_;
    std::uint32_t slot_ = 0;
};

}  // namespace nearfield::viewer
