#pragma once

#include <SDL.h>
#include <tools/rendering/gpu.hpp>
#include <tools/rendering/vulkan_painter.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::viewer {

/// SDL's video subsystem for the lifetime of this object.
class Video {
public:
    /// Throws std::runtime_error if there is no display.
    Video();
    ~Video() { SDL_Quit(); }
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;
};

/// A resizable window that Vulkan can present to.
class Window {
public:
    Window(const std::string& title, int width, int height);

    [[nodiscard]] SDL_Window* get() const { return window_.get(); }
    /// The instance extensions that a surface of this window needs.
    [[nodiscard]] std::vector<std::string> extensions() const;
    [[nodiscard]] vk::raii::SurfaceKHR make_surface(const tools::GpuInstance& instance) const;
    /// In pixels; zero while minimised.
    [[nodiscard]] vk::Extent2D extent() const;

private:
    struct Destroy {
        void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
    };
    Video video_;
    std::unique_ptr<SDL_Window, Destroy> window_;
};

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
