#include "contacts_item.hpp"

#include <QMouseEvent>
#include <QQuickWindow>
#include <QRunnable>

namespace nearfield::examples {

ContactsItem::ContactsItem(QQuickItem* parent) : QQuickItem(parent) {
    setAcceptedMouseButtons(Qt::LeftButton);
    connect(this, &QQuickItem::windowChanged, this, &ContactsItem::attach);
}

// Direct connections: all of these are called on the render thread, in this order in each frame.
void ContactsItem::attach(QQuickWindow* window) {
    if (window == nullptr) {
        return;
    }
    const auto on = [this, window](auto signal, auto work) {
        connect(
            window, signal, this, [this, work] { guarded(work); }, Qt::DirectConnection);
    };
    on(&QQuickWindow::beforeSynchronizing, [this] { synchronize(); });
    on(&QQuickWindow::beforeRendering, [this] { render_side_->record(); });
    on(&QQuickWindow::beforeRenderPassRecording, [this] { render_side_->draw(); });
    on(&QQuickWindow::sceneGraphInvalidated, [this] { render_side_.reset(); });
}

// No exception may pass through Qt: the first one ends the work and is told to the item's thread.
void ContactsItem::guarded(const std::function<void()>& work) {
    if (has_failed_) {
        return;
    }
    try {
        work();
    } catch (const std::exception& error) {
        has_failed_ = true;
        const QString text = QString::fromUtf8(error.what());
        QMetaObject::invokeMethod(this, [this, text] {
            error_ = text;
            emit failed();
        });
    }
}

// The item's thread stands still meanwhile, so both sides may be looked at.
void ContactsItem::synchronize() {
    if (!render_side_) {
        render_side_ = std::make_unique<RenderSide>(*window(), scene_);
    }
    render_side_->set_scene(scene_);
    const auto count = static_cast<int>(render_side_->snapshot().contacts.size());
    const bool behind = render_side_->snapshot().version != scene_.version();
    QMetaObject::invokeMethod(
        this,
        [this, count, behind] {
            if (count != count_) {
                count_ = count;
                emit count_changed();
            }
            if (behind && window() != nullptr) {
                window()->update();  // contacts arrive some frames later
            }
        },
        Qt::QueuedConnection);
}

// Called where the item leaves its window: what belongs to the render thread dies there.
void ContactsItem::releaseResources() {
    window()->scheduleRenderJob(
        QRunnable::create([side = std::shared_ptr<RenderSide>(std::move(render_side_))] {}),
        QQuickWindow::BeforeSynchronizingStage);
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
