#pragma once

#include "common/live_contacts.hpp"
#include "common/painter.hpp"

#include <cstdint>
#include <optional>

class QQuickWindow;

namespace nearfield::examples {

/// What the item does on the render thread of its window.
class RenderSide {
public:
    /// Adopts the device that the window renders with, whoever made it.
    RenderSide(QQuickWindow& window, const Scene& scene);
    ~RenderSide();
    RenderSide(const RenderSide&) = delete;
    RenderSide& operator=(const RenderSide&) = delete;

    void set_scene(const Scene& scene) { scene_ = scene; }
    [[nodiscard]] const Snapshot& snapshot() const { return contacts_.snapshot(); }

    /// Before the render pass: records nearfield's work into Qt's command buffer.
    void record();
    /// In the render pass, before Qt's own items.
    void draw();

private:
    QQuickWindow& window_;
    Scene scene_;
    VkPhysicalDevice physical_device_;
    VkDevice device_;
    LiveContacts contacts_;
    std::optional<Painter> painter_;
    std::uint64_t frame_ = 0;
};

}  // namespace nearfield::examples
