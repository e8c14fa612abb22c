#include <tools/drawing/canvas.hpp>
#include <tools/rendering/page.hpp>

#include <cstring>

namespace nearfield::tools {

std::string png_of(const FrameImage& image) {
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    Canvas canvas(width, height, palette::page);
    canvas.image(image.pixels, width, height, {});
    return canvas.png();
}

PageReader::PageReader(const Gpu& gpu, vk::Extent2D extent)
    : extent_(extent),
      pixels_(gpu, sizeof(std::uint32_t) * extent.width * extent.height,
              vk::BufferUsageFlagBits::eTransferDst) {}

void PageReader::record(const vk::raii::CommandBuffer& commands, const PaintedPage& page) const {
    commands.copyImageToBuffer(page.image(), vk::ImageLayout::eTransferSrcOptimal, pixels_.get(),
                               vk::BufferImageCopy()
                                   .setImageSubresource(whole_layer)
                                   .setImageExtent({extent_.width, extent_.height, 1}));
    commands.pipelineBarrier(
        vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {},
        vk::MemoryBarrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead), {},
        {});
}

FrameImage PageReader::read() const {
    FrameImage image{extent_.width, extent_.height, {}};
    image.pixels.resize(std::size_t{image.width} * image.height);
    std::memcpy(image.pixels.data(), pixels_.bytes().data(), pixels_.bytes().size());
    return image;
}

OffscreenPage::OffscreenPage(const Gpu& gpu, std::uint32_t width, std::uint32_t height)
    : painter_(gpu, {}, 1),
      page_(painter_.make_page({width, height})),
      reader_(gpu, page_.extent()),
      commands_(gpu) {}

FrameImage OffscreenPage::paint(const Drawing& drawing) {
    Mesh mesh(page_.extent().width, page_.extent().height);
    mesh.add(drawing);
    const vk::raii::CommandBuffer& commands = commands_.begin();
    painter_.paint(commands, 0, mesh, palette::panel, page_);
    reader_.record(commands, page_);
    commands_.submit();
    commands_.wait();
    return reader_.read();
}

}  // namespace nearfield::tools
