#pragma once

#include <SDL.h>
#include <tools/drawing/view.hpp>
#include <tools/viewer/panel.hpp>
#include <tools/viewer/screen.hpp>
#include <tools/viewer/simulation.hpp>

#include <cstdint>
#include <optional>

namespace nearfield::viewer {

/// Simulated mouse input: it presses at one place of the scene, moves to another in the first half
/// of the frames, and holds until the end.
struct Script {
    Vector2 from;
    Vector2 to;
    std::uint32_t frames = 0;

    /// Pushes this frame's events into the event queue, as real mouse events.
    void play(std::uint32_t frame, const tools::View& view) const;
};

/// A window with a scene. A frame handles events, runs the simulation and its queries, and paints.
class Viewer {
public:
    Viewer(const Settings& settings, const Wishes& wishes);

    /// Runs until the window is closed, or for the given number of frames.
    void run(std::optional<std::uint32_t> frames, const std::optional<Script>& script);
    void resize(int width, int height);
    [[nodiscard]] tools::FrameImage picture() { return screen_.picture(); }

private:
    [[nodiscard]] tools::View view() const;
    bool handle_events();
    void handle(const SDL_Event& event);
    void handle_key(SDL_Keycode key);
    void reload_shaders();
    void advance();
    void advance_bodies();
    void advance_clearances();
    void go_back(const std::string& why);
    bool show();

    Window window_;
    tools::GpuInstance instance_;
    vk::raii::SurfaceKHR surface_;
    tools::Gpu gpu_;
    Gui gui_;
    Screen screen_;
    Simulation simulation_;
    Wishes wishes_;
    Wishes worked_;  // the last ones that worked
    Reading reading_;
    tools::Drawing drawing_;
};

}  // namespace nearfield::viewer
