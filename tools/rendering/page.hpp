#pragma once

#include <tools/rendering/drawing.hpp>
#include <tools/rendering/vulkan_painter.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A picture in memory: 0xAARRGGBB with alpha 255, row by row from the top.
struct FrameImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> pixels;
};

/// Encodes an image as a PNG file.
[[nodiscard]] std::string png_of(const FrameImage& image);

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
