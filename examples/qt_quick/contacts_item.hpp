#pragma once

#include "common/scene.hpp"
#include "render_side.hpp"

#include <QQuickItem>
#include <functional>
#include <memory>

namespace nearfield::examples {

/// A Qt Quick item that shows two shapes and their contacts, on the window's own Vulkan device,
/// under all other items. The mouse drags the shapes.
class ContactsItem : public QQuickItem {
    Q_OBJECT
    Q_PROPERTY(int count READ count NOTIFY count_changed)

public:
    explicit ContactsItem(QQuickItem* parent = nullptr);

    /// Contacts in the last frame that was shown.
    [[nodiscard]] int count() const { return count_; }
    /// Why nothing can be shown; empty where all is well.
    [[nodiscard]] QString error() const { return error_; }

signals:
    void count_changed();
    void failed();

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void releaseResources() override;

private:
    void attach(QQuickWindow* window);
    [[nodiscard]] Vector2 to_world(const QPointF& position) const;

    // On the render thread.
    void guarded(const std::function<void()>& work);
    void synchronize();

    // Of the thread that the item lives on.
    Scene scene_;
    int count_ = 0;
    QString error_;
    // Of the render thread: made in its first frame, gone with its scene graph.
    std::unique_ptr<RenderSide> render_side_;
    bool has_failed_ = false;
};

}  // namespace nearfield::examples
