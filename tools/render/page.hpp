#pragma once

#include <tools/render/drawing.hpp>
#include <tools/render/frame_image.hpp>
#include <tools/render/vulkan_painter.hpp>

namespace nearfield::tools {

/// Reads a painted page back, in two steps.
class PageReader {
public:
    PageReader(const Gpu& gpu, vk::Extent2D extent);

    /// After the page is painted, before anything else happens to it.
    void record(const vk::raii::CommandBuffer& commands, const PaintedPage& page) const;
    /// Once the device has done that.
    [[nodiscard]] FrameImage read() const;

private:
    vk::Extent2D extent_;
    HostBuffer pixels_;
};

/// Paints drawings without a window.
class OffscreenPage {
public:
    OffscreenPage(const Gpu& gpu, std::uint32_t width, std::uint32_t height);

    [[nodiscard]] FrameImage paint(const Drawing& drawing);

private:
    VulkanPainter painter_;
    PaintedPage page_;
    PageReader reader_;
    Commands commands_;
};

}  // namespace nearfield::tools
