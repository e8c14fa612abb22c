#include "render_side.hpp"

#include <private/qrhivulkan_p.h>

#include <QQuickWindow>
#include <QSGRendererInterface>
#include <QVulkanInstance>

namespace nearfield::examples {
namespace {

// Qt returns pointers to Vulkan handles.
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

RenderSide::Guest::Guest(QQuickWindow& window, const Scene& scene)
    : device(resource<VkDevice>(window, QSGRendererInterface::DeviceResource)),
      contacts(host_device(window), frames_in_flight(window), scene),
      painter(resource<VkPhysicalDevice>(window, QSGRendererInterface::PhysicalDeviceResource),
              device, resource<VkRenderPass>(window, QSGRendererInterface::RenderPassResource),
              frames_in_flight(window)) {}

RenderSide::Guest::~Guest() {
    vkDeviceWaitIdle(device);  // Qt's last frames may still use the objects destroyed next
}

const Snapshot* RenderSide::snapshot() const {
    return guest_ ? &guest_->contacts.snapshot() : nullptr;
}

// Qt numbers frames only modulo those in flight; it has waited for the slot's previous frame.
void RenderSide::record() {
    keep_error([this] {
        if (!guest_) {
            guest_.emplace(window_, scene_);
        }
        ++guest_->frame;
        window_.beginExternalCommands();
        guest_->contacts.record(
            resource<VkCommandBuffer>(window_, QSGRendererInterface::CommandListResource),
            guest_->frame, scene_);
        window_.endExternalCommands();
    });
}

void RenderSide::draw() {
    keep_error([this] {
        const QSize size = window_.size() * window_.effectiveDevicePixelRatio();
        const auto slot = static_cast<std::uint32_t>(window_.graphicsStateInfo().currentFrameSlot);
        guest_->painter.upload(slot, examples::draw(scene_, guest_->contacts.snapshot(),
                                                    {static_cast<double>(size.width()),
                                                     static_cast<double>(size.height())}));
        window_.beginExternalCommands();
        guest_->painter.draw(
            resource<VkCommandBuffer>(window_, QSGRendererInterface::CommandListResource), slot,
            {static_cast<std::uint32_t>(size.width()), static_cast<std::uint32_t>(size.height())});
        window_.endExternalCommands();
    });
}

void RenderSide::leave() {
    release();
    has_left_ = true;
}

void RenderSide::keep_error(const std::function<void()>& work) {
    if (has_left_ || !error_.empty()) {
        return;
    }
    try {
        work();
    } catch (const std::exception& error) {
        error_ = error.what();
        // One more frame, so that the item receives the result.
        QMetaObject::invokeMethod(&window_, &QQuickWindow::update, Qt::QueuedConnection);
    }
}

}  // namespace nearfield::examples
