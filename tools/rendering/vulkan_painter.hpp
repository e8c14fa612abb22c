#pragma once

#include <tools/drawing/canvas.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/rendering/gpu.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The glyph coverage of each pixel, 0 to 255, row by row.
struct Letters {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    std::vector<std::uint8_t> coverage = {255};
};

/// A page in device memory, painted with four samples per pixel.
class PaintedPage {
public:
    /// Blue in the lowest byte, then green, red, alpha.
    static constexpr vk::Format format = vk::Format::eB8G8R8A8Unorm;
    /// Every device supports this sample count for an image of this format.
    static constexpr vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e4;

    PaintedPage(const Gpu& gpu, vk::RenderPass render_pass, vk::Extent2D extent);

    [[nodiscard]] vk::Extent2D extent() const { return extent_; }
    /// In the layout eTransferSrcOptimal once painted; commands recorded after that may copy it.
    [[nodiscard]] vk::Image image() const { return resolved_.get(); }
    [[nodiscard]] vk::Framebuffer framebuffer() const { return *framebuffer_; }

private:
    vk::Extent2D extent_;
    DeviceImage sampled_;
    DeviceImage resolved_;
    vk::raii::Framebuffer framebuffer_;
};

/// Paints meshes with Vulkan: one pipeline, and buffers for each frame in flight.
class VulkanPainter {
public:
    VulkanPainter(const Gpu& gpu, const Letters& letters, std::uint32_t frames_in_flight);

    [[nodiscard]] PaintedPage make_page(vk::Extent2D extent) const {
        return {gpu_, *render_pass_, extent};
    }
    /// Records the painting of the whole page. Precondition: the device has finished with the
    /// slot's last mesh.
    void paint(const vk::raii::CommandBuffer& commands, std::uint32_t slot, const Mesh& mesh,
               const Color& background, const PaintedPage& page);

private:
    struct Slot {
        HostBuffer vertices;
        HostBuffer indices;
    };

    void upload(const Letters& letters);

    const Gpu& gpu_;
    vk::raii::RenderPass render_pass_;
    vk::raii::Sampler sampler_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_;
    DeviceImage letters_;
    vk::raii::DescriptorPool sets_;
    vk::raii::DescriptorSet set_;
    std::vector<Slot> slots_;
};

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
