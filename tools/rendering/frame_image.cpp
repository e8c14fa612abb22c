#include <tools/drawing/canvas.hpp>
#include <tools/rendering/frame_image.hpp>

namespace nearfield::tools {

std::string png_of(const FrameImage& image) {
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    Canvas canvas(width, height, palette::page);
    canvas.image(image.pixels, width, height, {});
    return canvas.png();
}

}  // namespace nearfield::tools
