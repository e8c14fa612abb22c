#include "contacts_item.hpp"
#include "way.hpp"

#include <QCommandLineParser>
#include <QGuiApplication>
#include <QMouseEvent>
#include <QQuickItem>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>

// Two shapes that the mouse drags, and their contacts, drawn by our own Vulkan pipeline below the
// items of Qt Quick. nearfield works on the same device, within Qt's frames.

namespace {

using namespace nearfield::examples;

struct Options {
    QString way;
    QString screenshot;
    nearfield::Vector2 drag;
};

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

nearfield::Vector2 parse_pair(const QString& text) {
    const QStringList parts = text.split(',');
    bool good_x = false;
    bool good_y = false;
    const nearfield::Vector2 pair{parts.value(0).toDouble(&good_x),
                                  parts.value(1).toDouble(&good_y)};
    if (parts.size() != 2 || !good_x || !good_y) {
        throw UsageError("--drag takes X,Y, not \"" + text.toStdString() + "\"");
    }
    return pair;
}

Options parse_options(const QCoreApplication& application) {
    const QCommandLineOption way("way", "whose Vulkan device: qt, ours; image: ours, and no window",
                                 "WAY", "qt");
    const QCommandLineOption screenshot("screenshot", "write a picture and leave", "FILE.png");
    const QCommandLineOption drag("drag", "before the picture, drag the star by this (world units)",
                                  "X,Y", "0,0");
    QCommandLineParser parser;
    parser.addOptions({way, screenshot, drag});
    parser.addHelpOption();
    parser.process(application);
    return {parser.value(way), parser.value(screenshot), parse_pair(parser.value(drag))};
}

std::unique_ptr<Way> make_way(const Options& options) {
    if (options.way == "qt") {
        return on_device_of_qt();
    }
    if (options.way == "ours") {
        return on_own_device();
    }
    if (options.way == "image") {
        if (options.screenshot.isEmpty()) {
            throw UsageError("--way image shows no window: it needs --screenshot");
        }
        return into_own_image();
    }
    throw UsageError("--way is qt, ours or image, not \"" + options.way.toStdString() + "\"");
}

/// Sends a mouse event at a position in world coordinates.
void send_mouse(QQuickView& view, QEvent::Type type, const nearfield::Vector2& world) {
    const auto at = View{double(view.width()), double(view.height())}.to_pixel(world);
    const bool moves = type == QEvent::MouseMove;
    QMouseEvent event(type, {at.x, at.y}, view.mapToGlobal(QPointF(at.x, at.y)),
                      moves ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(&view, &event);
}

void take_screenshot(Way& way, const ContactsItem& item, const Options& options) {
    const auto render = [&way, &item] {
        QImage picture = way.render();
        QCoreApplication::processEvents();  // messages from the render thread
        if (!item.error().isEmpty()) {
            throw std::runtime_error(item.error().toStdString());
        }
        return picture;
    };
    render();
    send_mouse(way.view(), QEvent::MouseButtonPress, drag_position(options.drag, 0));
    for (int step = 1; step <= drag_steps; ++step) {
        send_mouse(way.view(), QEvent::MouseMove, drag_position(options.drag, step));
        render();
    }
    send_mouse(way.view(), QEvent::MouseButtonRelease, drag_position(options.drag, drag_steps));
    QImage picture;
    for (int frame = 0; frame < 8; ++frame) {  // more than are in flight, and one for the label
        picture = render();
    }
    if (!picture.save(options.screenshot)) {
        throw std::runtime_error("cannot write " + options.screenshot.toStdString());
    }
}

int run(const QGuiApplication& application) {
    const Options options = parse_options(application);
    const std::unique_ptr<Way> way = make_way(options);
    QQuickView& view = way->view();
    QString error;
    QObject::connect(&view, &QQuickWindow::sceneGraphError, &view,
                     [&error](QQuickWindow::SceneGraphError, const QString& message) {
                         error = message;
                         QCoreApplication::exit(1);
                     });
    view.setTitle("nearfield in Qt Quick");
    view.setColor(QColor(background_color[0], background_color[1], background_color[2]));
    view.setResizeMode(QQuickView::SizeRootObjectToView);
    view.resize(640, 480);
    view.setSource(QUrl("qrc:/contacts.qml"));
    auto* item = qobject_cast<ContactsItem*>(view.rootObject());
    if (item == nullptr) {
        throw std::runtime_error("contacts.qml cannot be loaded");
    }
    if (!options.screenshot.isEmpty()) {
        take_screenshot(*way, *item, options);
        return 0;
    }
    QObject::connect(item, &ContactsItem::failed, [&error, item] {
        error = item->error();
        QCoreApplication::exit(1);
    });
    view.show();
    const int status = QGuiApplication::exec();
    if (!error.isEmpty()) {
        throw std::runtime_error(error.toStdString());
    }
    return status;
}

/// Qt aborts the program if it cannot reach the display; exit with a status instead.
void print_message(QtMsgType type, const QMessageLogContext& context, const QString& text) {
    std::fprintf(stderr, "%s\n", qPrintable(qFormatLogMessage(type, context, text)));
    if (type == QtFatalMsg) {
        std::_Exit(1);
    }
}

}  // namespace

int main(int argc, char** argv) {
    qInstallMessageHandler(print_message);
    QQuickWindow::setGraphicsApi(QSGRendererInterface::Vulkan);
    const QGuiApplication application(argc, argv);
    qmlRegisterType<ContactsItem>("Nearfield", 1, 0, "Contacts");
    try {
        return run(application);
    } catch (const UsageError& error) {
        std::fprintf(stderr, "qt_quick: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "qt_quick: %s\n", error.what());
        return 1;
    }
}
