#include "way.hpp"

#include <QGuiApplication>
#include <QQuickGraphicsConfiguration>
#include <QVersionNumber>
#include <QVulkanInstance>
#include <stdexcept>

namespace nearfield::examples {
namespace {

class OnDeviceOfQt : public Way {
public:
    OnDeviceOfQt() {
        // By default Qt would create a Vulkan 1.0 instance.
        instance_.setApiVersion(QVersionNumber(1, 1));
        instance_.setExtensions(QQuickGraphicsConfiguration::preferredInstanceExtensions());
        create(instance_);
        view_.setVulkanInstance(&instance_);
    }

    QQuickView& view() override { return view_; }
    QImage render() override { return render_window(view_); }

private:
    QVulkanInstance instance_;
    QQuickView view_;  // and with it Qt's device: destroyed before the instance
};

}  // namespace

std::unique_ptr<Way> on_device_of_qt() {
    return std::make_unique<OnDeviceOfQt>();
}

void create(QVulkanInstance& instance) {
    if (!instance.create()) {
        const QString text =
            QString("there is no Vulkan instance on Qt's platform \"%1\" (VkResult %2)")
                .arg(QGuiApplication::platformName())
                .arg(instance.errorCode());
        throw std::runtime_error(text.toStdString());
    }
}

QImage render_window(QQuickView& view) {
    view.show();
    while (!view.isExposed()) {
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    return view.grabWindow();
}

}  // namespace nearfield::examples
