#include "picture_file.hpp"

#include <cairo.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace nearfield::test {

Pixels read_picture(const std::filesystem::path& file) {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_image_surface_create_from_png(file.c_str()), &cairo_surface_destroy);
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error("no picture in " + file.string());
    }
    Pixels pixels;
    pixels.width = cairo_image_surface_get_width(surface.get());
    pixels.height = cairo_image_surface_get_height(surface.get());
    const unsigned char* rows = cairo_image_surface_get_data(surface.get());
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            std::uint32_t word = 0;
            std::memcpy(&word, rows + y * cairo_image_surface_get_stride(surface.get()) + 4 * x,
                        sizeof(word));
            pixels.colors.push_back({static_cast<std::uint8_t>(word >> 16U),
                                     static_cast<std::uint8_t>(word >> 8U),
                                     static_cast<std::uint8_t>(word), 255});
        }
    }
    return pixels;
}

}  // namespace nearfield::test
