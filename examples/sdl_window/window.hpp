#pragma once

#include <SDL.h>
#include <vulkan/vulkan.h>

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
    [[nodiscard]] VkExtent2D extent() const;

private:
    SDL_Window* window_ = nullptr;
};

/// The Vulkan surface of a window.
class Surface {
public:
    Surface(const Window& window, VkInstance instance);
    ~Surface() { vkDestroySurfaceKHR(instance_, surface_, nullptr); }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    [[nodiscard]] VkSurfaceKHR get() const { return surface_; }
    [[nodiscard]] bool can_present(VkPhysicalDevice device, std::uint32_t family) const;

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

}  // namespace nearfield::examples
