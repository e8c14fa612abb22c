#include <nearfield/diagnostics.hpp>

#include <tools/common/library.hpp>
#include <tools/io/input_error.hpp>
#include <tools/rendering/pictures.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/viewer/viewer.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::viewer {

using simulation::operator+;
using simulation::operator-;
using simulation::operator*;

void Script::play(std::uint32_t frame, const tools::View& view) const {
    const double part = std::min(1.0, 2.0 * frame / frames);
    const Vector2 at = view.to_page(from + part * (to - from));
    SDL_Event event{};
    event.type = frame == 0 ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEMOTION;
    const auto x = static_cast<Sint32>(std::lround(at.x));
    const auto y = static_cast<Sint32>(std::lround(at.y));
    if (frame == 0) {
        event.button.button = SDL_BUTTON_LEFT;
        event.button.x = x;
        event.button.y = y;
    } else {
        event.motion.x = x;
        event.motion.y = y;
    }
    SDL_PushEvent(&event);
}

namespace {

constexpr int first_width = 1280;
constexpr int first_height = 760;

Vector2 place_of(Sint32 x, Sint32 y) {
    return {static_cast<double>(x), static_cast<double>(y)};
}

}  // namespace

Viewer::Viewer(const Settings& settings, const Wishes& wishes)
    : window_("nearfield", first_width, first_height),
      instance_(window_.extensions()),
      surface_(window_.make_surface(instance_)),
      gpu_(instance_,
           [this](const vk::raii::PhysicalDevice& device, std::uint32_t family) {
               return device.getSurfaceSupportKHR(family, *surface_) == VK_TRUE;
           }),
      gui_(window_.get()),
      screen_(gpu_, *surface_, window_.extent(), Gui::letters()),
      simulation_(gpu_.host_device(), settings, wishes.choices),
      wishes_(wishes),
      worked_(wishes) {}

tools::View Viewer::view() const {
    const vk::Extent2D extent = window_.extent();
    const double left = static_cast<double>(panel_width);
    return {simulation_.view(),
            {{left, 0.0},
             {std::max(left + 1.0, static_cast<double>(extent.width)),
              static_cast<double>(extent.height)}}};
}

void Viewer::resize(int width, int height) {
    SDL_SetWindowSize(window_.get(), width, height);
}

void Viewer::handle_key(SDL_Keycode key) {
    switch (key) {
        case SDLK_SPACE:
            wishes_.running = !wishes_.running;
            break;
        case SDLK_n:
            wishes_.running = false;
            wishes_.step = true;
            break;
        case SDLK_r:
            wishes_.restart = true;
            break;
        case SDLK_F5:
            reload_shaders();
            break;
        default:
            break;
    }
}

/// Development aid for the library's shaders; needs a build with shader reload.
void Viewer::reload_shaders() {
    const Expected<std::uint32_t> changed = nearfield::reload_shaders(simulation_.context());
    reading_.notice = changed.has_value()
                          ? "Shaders that changed: " + std::to_string(*changed) + "."
                          : changed.error().text();
}

void Viewer::handle(const SDL_Event& event) {
    switch (event.type) {
        case SDL_MOUSEBUTTONDOWN: {
            const Vector2 place = place_of(event.button.x, event.button.y);
            if (event.button.button == SDL_BUTTON_LEFT && !Gui::wants_mouse() &&
                place.x >= static_cast<double>(panel_width)) {
                simulation_.grab(view().to_world(place));
            }
            break;
        }
        case SDL_MOUSEMOTION:
            simulation_.drag_to(view().to_world(place_of(event.motion.x, event.motion.y)));
            break;
        case SDL_MOUSEBUTTONUP:
            simulation_.release();
            break;
        case SDL_KEYDOWN:
            if (!Gui::wants_keys()) {
                handle_key(event.key.keysym.sym);
            }
            break;
        default:
            break;
    }
}

/// Returns false if the window was closed.
bool Viewer::handle_events() {
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        if (event.type == SDL_QUIT) {
            return false;
        }
        Gui::handle(event);
        handle(event);
    }
    return true;
}

/// Restores the choices that worked last.
void Viewer::go_back(const std::string& why) {
    reading_.notice = why;
    wishes_.choices = worked_.choices;
    wishes_.overlays = worked_.overlays;
    wishes_.running = false;
    simulation_.choose(wishes_.choices);
}

void Viewer::advance() {
    try {
        if (!(wishes_.choices == simulation_.choices())) {
            reading_.notice.clear();
            simulation_.choose(wishes_.choices);
        }
        if (wishes_.restart) {
            simulation_.restart();
        }
        drawing_.clear();
        simulation_.clearances() != nullptr ? advance_clearances() : advance_bodies();
        worked_ = wishes_;
    } catch (const tools::InputError& error) {
        go_back(error.what());
    } catch (const tools::LibraryError& error) {
        if (simulation_.choices() == worked_.choices && wishes_.overlays == worked_.overlays) {
            throw;  // there are no earlier choices to restore
        }
        go_back(error.what());
    }
    wishes_.restart = false;
    wishes_.step = false;
    reading_.time = simulation_.time();
}

void Viewer::advance_bodies() {
    if (wishes_.running || wishes_.step) {
        reading_.frame = simulation_.advance();
    }
    const simulation::Scene& scene = simulation_.scene();
    reading_.findings = find(simulation_, wishes_.overlays);
    draw(drawing_, simulation_, wishes_.overlays, reading_.findings, view());
    if (simulation_.drag().in_vain(scene)) {
        reading_.notice = "This body goes its own way, whatever pulls.";
    }
    reading_.clearances.reset();
    reading_.device = simulation_.context().device_name();
    reading_.tolerance = scene.tolerance;
    reading_.objects = scene.bodies.size();
    reading_.lines = simulation::line_count(scene);
}

void Viewer::advance_clearances() {
    simulation::ClearanceScene& scene = *simulation_.clearances();
    if (wishes_.running || wishes_.step) {
        scene.advance();
    } else {
        scene.ask();  // the user may have dragged something
    }
    tools::draw_clearances(drawing_, scene, view());
    reading_.clearances = scene.frame();
    reading_.objects = scene.obstacles().size();
    reading_.lines = scene.line_count();
}

bool Viewer::show() {
    const vk::Extent2D extent = window_.extent();
    tools::Mesh mesh(extent.width, extent.height);
    mesh.add(drawing_);
    Gui::begin();
    add_panel(wishes_, reading_, static_cast<float>(extent.height));
    Gui::add_to(mesh);
    return screen_.show(mesh);
}

void Viewer::run(std::optional<std::uint32_t> frames, const std::optional<Script>& script) {
    for (std::uint32_t frame = 0; !frames || frame < *frames; ++frame) {
        if (script) {
            script->play(frame, view());
        }
        if (!handle_events()) {
            return;
        }
        while (window_.extent() == vk::Extent2D()) {
            SDL_WaitEvent(nullptr);  // nothing to paint while minimised
        }
        advance();
        while (!show()) {
        }
    }
}

}  // namespace nearfield::viewer
