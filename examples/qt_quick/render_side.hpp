#pragma once

#include "common/live_contacts.hpp"
#include "common/painter.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

class QQuickWindow;

namespace nearfield::examples {

/// The item's work on the render thread of its window. It outlives the item if the item is
/// destroyed while a frame is being rendered. It throws no exceptions, because Qt could not pass
/// them on.
class RenderSide {
public:
    explicit RenderSide(QQuickWindow& window) : window_(window) {}

    /// Copies the scene. The item's thread must be blocked.
    void set_scene(const Scene& scene) { scene_ = scene; }
    /// The last snapshot drawn; null before the first frame.
    [[nodiscard]] const Snapshot* snapshot() const;
    /// The reason why nothing can be drawn; empty if there is no error.
    [[nodiscard]] const std::string& error() const { return error_; }

    /// Before the render pass: records nearfield's work into Qt's command buffer.
    void record();
    /// In the render pass, before Qt's own items.
    void draw();
    /// Releases everything on the device, which Qt may be about to destroy.
    void release() { guest_.reset(); }
    /// The same, permanently: the item has left the window.
    void leave();

private:
    /// The objects on the device that the window renders with, whoever created it.
    struct Guest {
        Guest(QQuickWindow& window, const Scene& scene);
        ~Guest();
        Guest(const Guest&) = delete;
        Guest& operator=(const Guest&) = delete;

        VkDevice device;
        LiveContacts contacts;
        Painter painter;
        std::uint64_t frame = 0;
    };

    void keep_error(const std::function<void()>& work);

    QQuickWindow& window_;
    Scene scene_;
    std::optional<Guest> guest_;
    std::string error_;
    bool has_left_ = false;
};

}  // namespace nearfield::examples
