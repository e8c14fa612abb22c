#pragma once

#include "common/live_contacts.hpp"
#include "common/own_device.hpp"
#include "common/painter.hpp"
#include "screen.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace nearfield::examples {

/// A minimal engine: three frames in flight, with nearfield's work at the start of each.
class Renderer {
public:
    static constexpr std::uint32_t frames_in_flight = 3;

    Renderer(const OwnDevice& device, vk::Instance instance, vk::SurfaceKHR surface,
             vk::Extent2D extent, const Scene& scene);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws a frame and shows it. `window_extent` is the current window size, not zero. If a file
    /// is given, a picture (PNG) is written to it. Returns false if the frame was skipped because
    /// the window changed in the meantime.
    bool draw(const Scene& scene, vk::Extent2D window_extent, const std::string& screenshot = {});

private:
    struct Frame {
        vk::UniqueCommandBuffer commands;
        vk::UniqueSemaphore available;  ///< the image to draw to
        vk::UniqueFence done;
    };

    void record(const Frame& frame, std::uint32_t slot, std::uint32_t image, const Scene& scene);
    void submit(const Frame& frame, std::uint32_t image);
    void resize(vk::Extent2D extent);

    const OwnDevice& device_;
    Screen screen_;
    Painter painter_;
    LiveContacts contacts_;
    vk::UniqueCommandPool pool_;
    std::array<Frame, frames_in_flight> frames_;
    std::uint64_t frame_ = 0;
};

}  // namespace nearfield::examples
