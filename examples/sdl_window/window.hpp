#pragma once

#include <SDL.h>
#include <vulkan/vulkan.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::examples {

/// A resizable window that Vulkan can present to.
class Window {
public:
    Window(const char* title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] SDL_Window* get() const { return window_; }
    /// The instance extensions that a surface of this window needs.
    [[nodiscard]] std::vector<std::string> extensions() const;
    /// In pixels.
    [[nodiscard]] vk::Extent2D extent() const;

private:
    SDL_Window* window_ = nullptr;
};

/// The Vulkan surface of a window.
[[nodiscard]] vk::UniqueSurfaceKHR make_surface(const Window& window, vk::Instance instance);

}  // namespace nearfield::examples
