#include "way.hpp"

#include "common/own_device.hpp"
#include "common/resources.hpp"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QQuickGraphicsConfiguration>
#include <QQuickGraphicsDevice>
#include <QQuickRenderControl>
#include <QQuickRenderTarget>
#include <QUrl>
#include <QVersionNumber>
#include <QVulkanInstance>
#include <optional>
#include <stdexcept>

namespace nearfield::examples {
namespace {

/// Creates the instance, or throws if this Qt, its platform or this machine has no Vulkan.
void create(QVulkanInstance& instance) {
    if (!instance.create()) {
        const QString text =
            QString("there is no Vulkan instance on Qt's platform \"%1\" (VkResult %2)")
                .arg(QGuiApplication::platformName())
                .arg(instance.errorCode());
        throw std::runtime_error(text.toStdString());
    }
}

/// Waits until the window system shows the window, then renders as Way::render.
QImage render_window(QQuickView& view) {
    view.show();
    while (!view.isExposed()) {
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    return view.grabWindow();
}

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

class OnOwnDevice : public Way {
public:
    OnOwnDevice() : own_instance_(make_instance(surface_extensions())) {
        instance_.setVkInstance(*own_instance_);
        create(instance_);
        view_.setVulkanInstance(&instance_);
        view_.create();
        device_.emplace(*own_instance_, [this](vk::PhysicalDevice device, std::uint32_t family) {
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
    vk::UniqueInstance own_instance_;
    QVulkanInstance instance_;
    std::optional<OwnDevice> device_;
    QQuickView view_;
};

constexpr vk::Format format = vk::Format::eR8G8B8A8Unorm;
/// In which Qt leaves it.
constexpr vk::ImageLayout layout_after = vk::ImageLayout::eColorAttachmentOptimal;

class IntoOwnImage : public Way {
public:
    IntoOwnImage()
        : own_instance_(make_instance(surface_extensions())),
          device_(*own_instance_, [](vk::PhysicalDevice, std::uint32_t) { return true; }),
          control_(std::make_unique<QQuickRenderControl>()),
          view_(std::make_unique<QQuickView>(QUrl(), control_.get())) {
        instance_.setVkInstance(*own_instance_);
        create(instance_);
        view_->setVulkanInstance(&instance_);
        view_->setGraphicsDevice(QQuickGraphicsDevice::fromDeviceObjects(
            device_.physical_device(), device_.device(), static_cast<int>(device_.queue_family())));
    }
    QQuickView& view() override { return *view_; }

    QImage render() override {
        if (!image_.image) {
            start();
        }
        QCoreApplication::processEvents();
        control_->polishItems();
        control_->beginFrame();
        control_->sync();
        control_->render();
        control_->endFrame();  // waits until the image is complete
        const std::vector<std::uint8_t> pixels =
            read_back(device_, *image_.image, layout_after, extent());
        return QImage(pixels.data(), view_->width(), view_->height(), QImage::Format_RGBA8888)
            .copy();
    }

private:
    [[nodiscard]] vk::Extent2D extent() const {
        return {static_cast<std::uint32_t>(view_->width()),
                static_cast<std::uint32_t>(view_->height())};
    }

    void start() {
        if (!control_->initialize()) {
            throw std::runtime_error("Qt Quick cannot render with our device");
        }
        image_ =
            DeviceImage(device_.physical_device(), device_.device(), format, extent(),
                        vk::ImageUsageFlagBits::eColorAttachment |
                            vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferSrc,
                        vk::ImageAspectFlagBits::eColor);
        view_->setRenderTarget(
            QQuickRenderTarget::fromVulkanImage(*image_.image, VK_IMAGE_LAYOUT_UNDEFINED,
                                                static_cast<VkFormat>(format), view_->size()));
    }

    // Destruction runs from the bottom: the window, the image, the device, Qt's wrapper, the
    // instance.
    vk::UniqueInstance own_instance_;
    QVulkanInstance instance_;
    OwnDevice device_;
    DeviceImage image_;
    std::unique_ptr<QQuickRenderControl> control_;
    std::unique_ptr<QQuickView> view_;
};

}  // namespace

std::unique_ptr<Way> on_device_of_qt() {
    return std::make_unique<OnDeviceOfQt>();
}

std::unique_ptr<Way> on_own_device() {
    return std::make_unique<OnOwnDevice>();
}

std::unique_ptr<Way> into_own_image() {
    return std::make_unique<IntoOwnImage>();
}

}  // namespace nearfield::examples
