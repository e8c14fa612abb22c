#include <SDL_vulkan.h>
#include <tools/viewer/screen.hpp>

#include <algorithm>
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

namespace {

/// Selects a format whose bytes are displayed without conversion.
vk::SurfaceFormatKHR choose_format(const tools::Gpu& gpu, vk::SurfaceKHR surface) {
    const auto offered = gpu.physical_device().getSurfaceFormatsKHR(surface);
    for (const vk::SurfaceFormatKHR& each : offered) {
        if (each.format == vk::Format::eB8G8R8A8Unorm ||
            each.format == vk::Format::eR8G8B8A8Unorm) {
            return each;
        }
    }
    throw tools::NoGpu("the window takes neither B8G8R8A8_UNORM nor R8G8B8A8_UNORM");
}

vk::Extent2D clamped(vk::Extent2D extent, const vk::SurfaceCapabilitiesKHR& can) {
    return {std::clamp(extent.width, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(extent.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

vk::Offset3D corner(vk::Extent2D extent) {
    return {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
}

}  // namespace

Screen::Frame::Frame(const tools::Gpu& gpu)
    : commands(gpu), available(gpu.device(), vk::SemaphoreCreateInfo()) {}

Screen::Screen(const tools::Gpu& gpu, vk::SurfaceKHR surface, vk::Extent2D extent,
               const tools::Letters& letters)
    : gpu_(gpu),
      surface_(surface),
      painter_(gpu, letters, frames_in_flight),
      frames_{Frame(gpu), Frame(gpu)} {
    fit(extent);
}

Screen::~Screen() {
    gpu_.device().waitIdle();
}

void Screen::fit(vk::Extent2D extent) {
    gpu_.device().waitIdle();
    const vk::SurfaceCapabilitiesKHR can =
        gpu_.physical_device().getSurfaceCapabilitiesKHR(surface_);
    const vk::SurfaceFormatKHR format = choose_format(gpu_, surface_);
    extent_ = clamped(extent, can);
    std::uint32_t count = std::max(can.minImageCount, 3U);
    if (can.maxImageCount != 0) {
        count = std::min(count, can.maxImageCount);
    }
    swapchain_ = vk::raii::SwapchainKHR(gpu_.device(),
                                        vk::SwapchainCreateInfoKHR()
                                            .setSurface(surface_)
                                            .setMinImageCount(count)
                                            .setImageFormat(format.format)
                                            .setImageColorSpace(format.colorSpace)
                                            .setImageExtent(extent_)
                                            .setImageArrayLayers(1)
                                            .setImageUsage(vk::ImageUsageFlagBits::eTransferDst)
                                            .setPreTransform(can.currentTransform)
                                            .setPresentMode(vk::PresentModeKHR::eFifo)
                                            .setClipped(VK_TRUE)
                                            .setOldSwapchain(*swapchain_));
    images_.clear();
    painted_.clear();
    for (const VkImage image : swapchain_.getImages()) {
        images_.emplace_back(image);
        painted_.emplace_back(gpu_.device(), vk::SemaphoreCreateInfo());
    }
    page_.emplace(painter_.make_page(extent));
}

bool Screen::show(const tools::Mesh& mesh) {
    const vk::Extent2D extent(mesh.width(), mesh.height());
    if (page_->extent() != extent) {
        fit(extent);
    }
    Frame& frame = frames_.at(slot_);
    frame.commands.wait();
    std::uint32_t image = 0;
    try {
        image = swapchain_.acquireNextImage(UINT64_MAX, *frame.available).second;
    } catch (const vk::OutOfDateKHRError&) {
        fit(extent);
        return false;
    }
    record(frame.commands.begin(), image, mesh);
    frame.commands.submit(*frame.available, *painted_.at(image));
    slot_ = (slot_ + 1) % frames_in_flight;
    if (!present(image)) {
        fit(extent);
    }
    return true;
}

void Screen::record(const vk::raii::CommandBuffer& commands, std::uint32_t image,
                    const tools::Mesh& mesh) {
    painter_.paint(commands, slot_, mesh, tools::palette::panel, *page_);
    const vk::Image target = images_.at(image);
    // Starts at the stage in which the submission waits for the image.
    const tools::ImageUse copied{vk::ImageLayout::eTransferDstOptimal,
                                 vk::PipelineStageFlagBits::eTransfer,
                                 vk::AccessFlagBits::eTransferWrite};
    tools::change_use(commands, target,
                      {vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits::eTransfer, {}},
                      copied);
    commands.blitImage(page_->image(), vk::ImageLayout::eTransferSrcOptimal, target, copied.layout,
                       vk::ImageBlit()
                           .setSrcSubresource(tools::whole_layer)
                           .setSrcOffsets({vk::Offset3D(), corner(page_->extent())})
                           .setDstSubresource(tools::whole_layer)
                           .setDstOffsets({vk::Offset3D(), corner(extent_)}),
                       vk::Filter::eNearest);
    tools::change_use(
        commands, target, copied,
        {vk::ImageLayout::ePresentSrcKHR, vk::PipelineStageFlagBits::eBottomOfPipe, {}});
}

bool Screen::present(std::uint32_t image) {
    try {
        return gpu_.queue().presentKHR(vk::PresentInfoKHR()
                                           .setWaitSemaphores(*painted_.at(image))
                                           .setSwapchains(*swapchain_)
                                           .setImageIndices(image)) == vk::Result::eSuccess;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
}

tools::FrameImage Screen::picture() {
    const tools::PageReader reader(gpu_, page_->extent());
    tools::Commands once(gpu_);
    reader.record(once.begin(), *page_);
    once.submit();
    once.wait();
    return reader.read();
}

}  // namespace nearfield::viewer
