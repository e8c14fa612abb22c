#pragma once

#include <SDL.h>
#include <tools/rendering/gpu.hpp>

#include <memory>
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

}  // namespace nearfield::viewer
