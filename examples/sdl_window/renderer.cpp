#include "renderer.hpp"

#include <cairo.h>

#include <cstddef>
#include <vector>

namespace nearfield::examples {
namespace {

CommandPool make_pool(const OwnDevice& device) {
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = device.queue_family();
    return create<CommandPool>(device.device(), vkCreateCommandPool, info, "vkCreateCommandPool");
}

VkCommandBuffer make_command_buffer(VkDevice device, VkCommandPool pool) {
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    require(vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
    return commands;
}

Fence make_signalled_fence(VkDevice device) {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    return create<Fence>(device, vkCreateFence, info, "vkCreateFence");
}

/// The pixel bytes are in the order of Screen::format: blue first.
void write_png(const std::string& file, std::vector<std::uint8_t> pixels, VkExtent2D extent) {
    const auto width = static_cast<int>(extent.width);
    cairo_surface_t* picture = cairo_image_surface_create_for_data(
        pixels.data(), CAIRO_FORMAT_RGB24, width, static_cast<int>(extent.height), 4 * width);
    const cairo_status_t status = cairo_surface_write_to_png(picture, file.c_str());
    cairo_surface_destroy(picture);
    if (status != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error("cannot write " + file + ": " + cairo_status_to_string(status));
    }
}

VkClearColorValue to_clear_value(const Color& color) {
    return {{static_cast<float>(color[0]) / 255.0F, static_cast<float>(color[1]) / 255.0F,
             static_cast<float>(color[2]) / 255.0F, 1.0F}};
}

}  // namespace

Renderer::Renderer(const OwnDevice& device, VkInstance instance, VkSurfaceKHR surface,
                   VkExtent2D extent, const Scene& scene)
    : device_(device),
      screen_(device, surface, extent),
      painter_(device.physical_device(), device.device(), screen_.render_pass(), frames_in_flight),
      contacts_(host_device(instance, device), frames_in_flight, scene),
      pool_(make_pool(device)) {
    for (Frame& frame : frames_) {
        frame.commands = make_command_buffer(device.device(), pool_.get());
        frame.available = make_semaphore(device.device());
        frame.done = make_signalled_fence(device.device());
    }
}

Renderer::~Renderer() {
    vkDeviceWaitIdle(device_.device());
}

bool Renderer::draw(const Scene& scene, VkExtent2D window_extent, const std::string& screenshot) {
    const VkExtent2D extent = screen_.extent();
    if (window_extent.width != extent.width || window_extent.height != extent.height) {
        resize(window_extent);
    }
    const auto slot = static_cast<std::uint32_t>(frame_ % frames_in_flight);
    const Frame& frame = frames_.at(slot);
    const VkFence done = frame.done.get();
    require(vkWaitForFences(device_.device(), 1, &done, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    const std::optional<std::uint32_t> image = screen_.acquire(frame.available.get());
    if (!image) {
        resize(window_extent);
        return false;
    }
    require(vkResetFences(device_.device(), 1, &done), "vkResetFences");
    record(frame, slot, *image, scene);
    submit(frame, *image);
    if (!screenshot.empty()) {
        write_png(screenshot,
                  read_back(device_, screen_.image(*image), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
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
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    require(vkBeginCommandBuffer(frame.commands, &begin), "vkBeginCommandBuffer");
    contacts_.record(frame.commands, frame_, scene);
    const VkExtent2D extent = screen_.extent();
    painter_.upload(slot, examples::draw(scene, contacts_.snapshot(),
                                         {static_cast<double>(extent.width),
                                          static_cast<double>(extent.height)}));
    screen_.begin(frame.commands, image, to_clear_value(background_color));
    painter_.draw(frame.commands, slot, extent);
    vkCmdEndRenderPass(frame.commands);
    require(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
}

void Renderer::submit(const Frame& frame, std::uint32_t image) {
    const VkSemaphore available = frame.available.get();
    const VkSemaphore drawn = screen_.drawn(image);
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &available;
    info.pWaitDstStageMask = &stage;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &frame.commands;
    info.signalSemaphoreCount = 1;
    info.pSignalSemaphores = &drawn;
    require(vkQueueSubmit(device_.queue(), 1, &info, frame.done.get()), "vkQueueSubmit");
}

void Renderer::resize(VkExtent2D extent) {
    require(vkDeviceWaitIdle(device_.device()), "vkDeviceWaitIdle");
    screen_.make_anew(extent);
}

}  // namespace nearfield::examples
