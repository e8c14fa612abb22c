#include "common/own_device.hpp"
#include "way.hpp"

#include <QQuickGraphicsDevice>
#include <QVulkanInstance>
#include <optional>

namespace nearfield::examples {
namespace {

class OnOwnDevice : public Way {
public:
    OnOwnDevice() : own_instance_(surface_extensions()) {
        instance_.setVkInstance(own_instance_.get());
        create(instance_);
        view_.setVulkanInstance(&instance_);
        view_.create();
        device_.emplace(own_instance_.get(), [this](VkPhysicalDevice device, std::uint32_t family) {
            return instance_.supportsPresent(device, family, &view_);
        });
        view_.setGraphicsDevice(
            QQuickGraphicsDevice::fromDeviceObjects(device_->physical_device(), device_->device(),
                                                    static_cast<int>(device_->queue_family())));
    }

    QQuickView& view() override { return view_; }
    QImage render() override { return render_window(view_); }

private:
    // Destruction order: the window, the device, Qt's wrapper of the instance, the instance.
    OwnInstance own_instance_;
    QVulkanInstance instance_;
    std::optional<OwnDevice> device_;
    QQuickView view_;
};

}  // namespace

std::unique_ptr<Way> on_own_device() {
    return std::make_unique<OnOwnDevice>();
}

}  // namespace nearfield::examples
