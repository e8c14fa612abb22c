#include "contacts_item.hpp"

#include <QMouseEvent>
#include <QQuickWindow>
#include <QRunnable>

namespace nearfield::examples {

ContactsItem::ContactsItem(QQuickItem* parent) : QQuickItem(parent) {
    setAcceptedMouseButtons(Qt::LeftButton);
    connect(this, &QQuickItem::windowChanged, this, &ContactsItem::attach);
}

ContactsItem::~ContactsItem() {
    if (window() != nullptr) {
        ContactsItem::releaseResources();  // ~QQuickItem would call its own version
    }
}

// Direct connections: called on the render thread, in this order in each frame.
void ContactsItem::attach(QQuickWindow* window) {
    if (window == nullptr) {
        return;
    }
    const auto side = std::make_shared<RenderSide>(*window);
    render_side_ = side;
    // The item's thread is blocked during this call, so both sides may be accessed.
    connect(window, &QQuickWindow::beforeSynchronizing, this, &ContactsItem::synchronize,
            Qt::DirectConnection);
    // The item's thread runs during these, so they must not access the item.
    connect(
        window, &QQuickWindow::beforeRendering, window, [side] { side->record(); },
        Qt::DirectConnection);
    connect(
        window, &QQuickWindow::beforeRenderPassRecording, window, [side] { side->draw(); },
        Qt::DirectConnection);
    connect(
        window, &QQuickWindow::sceneGraphInvalidated, window, [side] { side->release(); },
        Qt::DirectConnection);
}

// Called when the item leaves its window. Objects of the render thread are destroyed there.
void ContactsItem::releaseResources() {
    disconnect(window(), &QQuickWindow::beforeSynchronizing, this, nullptr);
    window()->scheduleRenderJob(QRunnable::create([side = render_side_] { side->leave(); }),
                                QQuickWindow::BeforeSynchronizingStage);
    render_side_.reset();
}

void ContactsItem::synchronize() {
    render_side_->set_scene(scene_);
    const Snapshot* snapshot = render_side_->snapshot();
    const auto count = snapshot != nullptr ? static_cast<int>(snapshot->contacts.size()) : 0;
    const bool is_behind = snapshot == nullptr || snapshot->version != scene_.version();
    const QString error = QString::fromStdString(render_side_->error());
    QMetaObject::invokeMethod(
        this, [this, count, is_behind, error] { show(count, is_behind, error); },
        Qt::QueuedConnection);
}

void ContactsItem::show(int count, bool is_behind, const QString& error) {
    if (error != error_) {
        error_ = error;
        emit failed();
    } else if (count != count_) {
        count_ = count;
        emit count_changed();
    }
    if (is_behind && error_.isEmpty() && window() != nullptr) {
        window()->update();  // contacts arrive some frames later
    }
}

Vector2 ContactsItem::to_world(const QPointF& position) const {
    return View{width(), height()}.to_world({position.x(), position.y()});
}

void ContactsItem::mousePressEvent(QMouseEvent* event) {
    scene_.press(to_world(event->position()));
}

void ContactsItem::mouseMoveEvent(QMouseEvent* event) {
    scene_.move(to_world(event->position()));
    window()->update();
}

void ContactsItem::mouseReleaseEvent(QMouseEvent* /*event*/) {
    scene_.release();
}

}  // namespace nearfield::examples
