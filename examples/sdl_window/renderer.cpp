#include "renderer.hpp"

#include <cairo.h>

#include <cstddef>
#include <vector>

namespace nearfield::examples {
namespace {

/// The pixel bytes are in the order of Screen::format: blue first.
void write_png(const std::string& file, std::vector<std::uint8_t> pixels, vk::Extent2D extent) {
    const auto width = static_cast<int>(extent.width);
    cairo_surface_t* picture = cairo_image_surface_create_for_data(
        pixels.data(), CAIRO_FORMAT_RGB24, width, static_cast<int>(extent.height), 4 * width);
    const cairo_status_t status = cairo_surface_write_to_png(picture, file.c_str());
    cairo_surface_destroy(picture);
    if (status != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error("cannot write " + file + ": " + cairo_status_to_string(status));
    }
}

vk::ClearColorValue to_clear_value(const Color& color) {
    return std::array{static_cast<float>(color[0]) / 255.0F, static_cast<float>(color[1]) / 255.0F,
                      static_cast<float>(color[2]) / 255.0F, 1.0F};
}

}  // namespace

Renderer::Renderer(const OwnDevice& device, vk::Instance instance, vk::SurfaceKHR surface,
                   vk::Extent2D extent, const Scene& scene)
    : device_(device),
      screen_(device, surface, extent),
      painter_(device.physical_device(), device.device(), screen_.render_pass(), frames_in_flight),
      contacts_(host_device(instance, device), frames_in_flight, scene),
      pool_(device.device().createCommandPoolUnique(
          {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queue_family()})) {
    for (Frame& frame : frames_) {
        frame.commands = std::move(
            device.device()
                .allocateCommandBuffersUnique({*pool_, vk::CommandBufferLevel::ePrimary, 1})
                .front());
        frame.available = device.device().createSemaphoreUnique({});
        frame.done = device.device().createFenceUnique({vk::FenceCreateFlagBits::eSignaled});
    }
}

Renderer::~Renderer() {
    device_.device().waitIdle();
}

bool Renderer::draw(const Scene& scene, vk::Extent2D window_extent, const std::string& screenshot) {
    if (window_extent != screen_.extent()) {
        resize(window_extent);
    }
    const auto slot = static_cast<std::uint32_t>(frame_ % frames_in_flight);
    const Frame& frame = frames_.at(slot);
    static_cast<void>(device_.device().waitForFences(*frame.done, VK_TRUE, UINT64_MAX));
    const std::optional<std::uint32_t> image = screen_.acquire(*frame.available);
    if (!image) {
        resize(window_extent);
        return false;
    }
    device_.device().resetFences(*frame.done);
    record(frame, slot, *image, scene);
    submit(frame, *image);
    if (!screenshot.empty()) {
        write_png(screenshot,
                  read_back(device_, screen_.image(*image), vk::ImageLayout::ePresentSrcKHR,
                            screen_.extent()),
                  screen_.extent());
    }
    if (!screen_.present(*image)) {
        resize(window_extent);
    }
    ++frame_;
    return true;
}

void Renderer::record(const Frame& frame, std::uint32_t slot, std::uint32_t image,
                      const Scene& scene) {
    const vk::CommandBuffer commands = *frame.commands;
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    contacts_.record(commands, frame_, scene);

    const vk::Extent2D extent = screen_.extent();
    painter_.upload(slot, examples::draw(scene, contacts_.snapshot(),
                                         {static_cast<double>(extent.width),
                                          static_cast<double>(extent.height)}));
    screen_.begin(commands, image, to_clear_value(background_color));
    painter_.draw(commands, slot, extent);
    commands.endRenderPass();
    commands.end();
}

void Renderer::submit(const Frame& frame, std::uint32_t image) {
    const vk::Semaphore drawn = screen_.drawn(image);
    const vk::PipelineStageFlags stage = vk::PipelineStageFlagBits::eColorAttachmentOutput;
    device_.queue().submit(vk::SubmitInfo()
                               .setWaitSemaphores(*frame.available)
                               .setWaitDstStageMask(stage)
                               .setCommandBuffers(*frame.commands)
                               .setSignalSemaphores(drawn),
                           *frame.done);
}

void Renderer::resize(vk::Extent2D extent) {
    device_.device().waitIdle();
    screen_.make_anew(extent);
}

}  // namespace nearfield::examples
