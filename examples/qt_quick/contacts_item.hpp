#pragma once

#include "common/scene.hpp"
#include "render_side.hpp"

#include <QQuickItem>
#include <memory>

namespace nearfield::examples {

/// A Qt Quick item that shows two shapes and their contacts on the window's own Vulkan device,
/// below all other items. The mouse drags the shapes.
class ContactsItem : public QQuickItem {
    Q_OBJECT
    Q_PROPERTY(int count READ count NOTIFY count_changed)

public:
    explicit ContactsItem(QQuickItem* parent = nullptr);
    ~ContactsItem() override;

    /// The number of contacts in the last frame shown.
    [[nodiscard]] int count() const { return count_; }
    /// The reason why nothing can be shown; empty if there is no error.
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
    void synchronize();
    void show(int count, bool is_behind, const QString& error);
    [[nodiscard]] Vector2 to_world(const QPointF& position) const;

    Scene scene_;
    int count_ = 0;
    QString error_;
    std::shared_ptr<RenderSide> render_side_;  ///< while the item is in a window
};

}  // namespace nearfield::examples
