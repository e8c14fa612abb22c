#include "window.hpp"

#include <SDL_vulkan.h>

namespace nearfield::examples {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + SDL_GetError());
}

}  // namespace

Window::Window(const char* title, int width, int height) {
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        fail("there is no display");
    }
    window_ = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
                               SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE);
    if (window_ == nullptr) {
        const std::string why = SDL_GetError();
        SDL_Quit();
        throw std::runtime_error("there is no window for Vulkan: " + why);
    }
}

Window::~Window() {
    SDL_DestroyWindow(window_);
    SDL_Quit();
}

std::vector<std::string> Window::extensions() const {
    unsigned int count = 0;
    if (SDL_Vulkan_GetInstanceExtensions(window_, &count, nullptr) == SDL_FALSE) {
        fail("SDL_Vulkan_GetInstanceExtensions");
    }
    std::vector<const char*> names(count);
    SDL_Vulkan_GetInstanceExtensions(window_, &count, names.data());
    return {names.begin(), names.end()};
}

vk::Extent2D Window::extent() const {
    int width = 0;
    int height = 0;
    SDL_Vulkan_GetDrawableSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

vk::UniqueSurfaceKHR make_surface(const Window& window, vk::Instance instance) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (SDL_Vulkan_CreateSurface(window.get(), instance, &surface) == SDL_FALSE) {
        fail("SDL_Vulkan_CreateSurface");
    }
    return vk::UniqueSurfaceKHR(surface, instance);
}

}  // namespace nearfield::examples
