#include "render_side.hpp"

#include <private/qrhivulkan_p.h>

#include <QQuickWindow>
#include <QSGRendererInterface>
#include <QVulkanInstance>

namespace nearfield::examples {
namespace {

// Qt gives pointers to Vulkan's handles.
template <class Resource>
Resource resource(QQuickWindow& window, QSGRendererInterface::Resource which) {
    const void* found = window.rendererInterface()->getResource(&window, which);
    if (found == nullptr) {
        throw std::runtime_error("Qt Quick does not render with Vulkan");
    }
    return *static_cast<const Resource*>(found);
}

HostDevice host_device(QQuickWindow& window) {
    auto* rhi = static_cast<QRhi*>(
        window.rendererInterface()->getResource(&window, QSGRendererInterface::RhiResource));
    if (rhi == nullptr || rhi->backend() != QRhi::Vulkan) {
        throw std::runtime_error("Qt Quick does not render with Vulkan");
    }
    const auto* handles = static_cast<const QRhiVulkanNativeHandles*>(rhi->nativeHandles());
    HostDevice host;
    host.instance = window.vulkanInstance()->vkInstance();
    host.physical_device = handles->physDev;
    host.device = handles->dev;
    host.queue = handles->gfxQueue;
    host.queue_family = static_cast<std::uint32_t>(handles->gfxQueueFamilyIdx);
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    return host;
}

std::uint32_t frames_in_flight(QQuickWindow& window) {
    return static_cast<std::uint32_t>(window.graphicsStateInfo().framesInFlight);
}

}  // namespace

RenderSide::RenderSide(QQuickWindow& window, const Scene& scene)
    : window_(window),
      scene_(scene),
      physical_device_(
          resource<VkPhysicalDevice>(window, QSGRendererInterface::PhysicalDeviceResource)),
      device_(resource<VkDevice>(window, QSGRendererInterface::DeviceResource)),
      contacts_(host_device(window), frames_in_flight(window), scene) {}

RenderSide::~RenderSide() {
    vkDeviceWaitIdle(device_);  // Qt's last frames may still draw with what goes now
}

// Qt numbers frames only modulo those in flight; it waited for the one that had this slot before.
void RenderSide::record() {
    ++frame_;
    if (!painter_) {
        painter_.emplace(physical_device_, device_,
                         resource<VkRenderPass>(window_, QSGRendererInterface::RenderPassResource),
                         frames_in_flight(window_));
    }
    window_.beginExternalCommands();
    contacts_.record(resource<VkCommandBuffer>(window_, QSGRendererInterface::CommandListResource),
                     frame_, scene_);
    window_.endExternalCommands();
}

void RenderSide::draw() {
    const QSize size = window_.size() * window_.effectiveDevicePixelRatio();
    const auto slot = static_cast<std::uint32_t>(window_.graphicsStateInfo().currentFrameSlot);
    painter_->upload(slot, examples::draw(scene_, contacts_.snapshot(),
                                          {double(size.width()), double(size.height())}));
    window_.beginExternalCommands();
    painter_->draw(
        resource<VkCommandBuffer>(window_, QSGRendererInterface::CommandListResource), slot,
        {static_cast<std::uint32_t>(size.width()), static_cast<std::uint32_t>(size.height())});
    window_.endExternalCommands();
}

}  // namespace nearfield::examples
