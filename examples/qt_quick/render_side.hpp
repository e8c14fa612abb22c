#pragma once

#include "common/live_contacts.hpp"
#include "common/painter.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

class QQuickWindow;

namespace nearfield::examples {

/// What the item does on the render thread of its window. It outlives the item where that goes
/// while a frame is being rendered. No exception leaves it: Qt could not pass one on.
class RenderSide {
public:
    explicit RenderSide(QQuickWindow& window) : window_(window) {}

    /// Takes over the scene, while the thread that the item lives on stands still.
    void set_scene(const Scene& scene) { scene_ = scene; }
    /// What was drawn last; nothing before there was a frame.
    [[nodiscard]] const Snapshot* snapshot() const;
    /// Why nothing can be drawn; empty where all is well.
    [[nodiscard]] const std::string& error() const { return error_; }

    /// Before the render pass: records nearfield's work into Qt's command buffer.
    void record();
    /// In the render pass, before Qt's own items.
    void draw();
    /// Lets go of the device, which Qt may be about to destroy.
    void release() { guest_.reset(); }
    /// The same for good: the item has left the window.
    void leave();

private:
    /// What is on the device that the window renders with, whoever made it.
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

    void guarded(const std::function<void()>& work);

    QQuickWindow& window_;
    Scene scene_;
    std::optional<Guest> guest_;
    std::string error_;
    bool has_left_ = false;
};

}  // namespace nearfield::examples
