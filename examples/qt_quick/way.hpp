#pragma once

#include <QImage>
#include <QQuickView>
#include <memory>

namespace nearfield::examples {

/// One way to have Qt Quick and nearfield on the same Vulkan device.
class Way {
public:
    Way() = default;
    virtual ~Way() = default;
    Way(const Way&) = delete;
    Way& operator=(const Way&) = delete;

    [[nodiscard]] virtual QQuickView& view() = 0;
    /// Renders a frame and returns the picture.
    virtual QImage render() = 0;
};

/// Qt makes instance and device; nearfield adopts them.
[[nodiscard]] std::unique_ptr<Way> on_device_of_qt();
/// We make instance and device; Qt and nearfield adopt them.
[[nodiscard]] std::unique_ptr<Way> on_own_device();
/// The same, but Qt renders into our own image instead of a window.
[[nodiscard]] std::unique_ptr<Way> into_own_image();

}  // namespace nearfield::examples
