#pragma once

#include <tools/rendering/drawing.hpp>
#include <tools/rendering/frame_image.hpp>
#include <tools/rendering/vulkan_painter.hpp>

namespace nearfield::tools {

/// Reads a painted page back in two steps.
class PageReader {
public:
    PageReader(const Gpu& gpu, vk::Extent2D extent);

    /// Records the copy: after the page is painted, before anything else uses it.
    void record(const vk::raii::CommandBuffer& commands, const PaintedPage& page) const;
    /// Call once the device has executed the copy.
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
