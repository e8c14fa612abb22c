#include <SDL_vulkan.h>
#include <tools/viewer/window.hpp>

#include <stdexcept>

namespace nearfield::viewer {

Video::Video() {
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        throw std::runtime_error(std::string("there is no display: ") + SDL_GetError());
    }
}

Window::Window(const std::string& title, int width, int height)
    : window_(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width,
                               height, SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE)) {
    if (!window_) {
        throw tools::NoGpu(std::string("there is no window for Vulkan: ") + SDL_GetError());
    }
}

std::vector<std::string> Window::extensions() const {
    unsigned int count = 0;
    SDL_Vulkan_GetInstanceExtensions(get(), &count, nullptr);
    std::vector<const char*> names(count);
    if (SDL_Vulkan_GetInstanceExtensions(get(), &count, names.data()) == SDL_FALSE) {
        throw tools::NoGpu(std::string("there is no surface for windows: ") + SDL_GetError());
    }
    return {names.begin(), names.end()};
}

vk::raii::SurfaceKHR Window::make_surface(const tools::GpuInstance& instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (SDL_Vulkan_CreateSurface(get(), *instance.get(), &surface) == SDL_FALSE) {
        throw tools::NoGpu(std::string("there is no surface for this window: ") + SDL_GetError());
    }
    return {instance.get(), surface};
}

vk::Extent2D Window::extent() const {
    int width = 0;
    int height = 0;
    SDL_Vulkan_GetDrawableSize(get(), &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace nearfield::viewer
