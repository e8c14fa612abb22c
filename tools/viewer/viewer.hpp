#pragma once

#include <tools/viewer/gui.hpp>
#include <tools/viewer/panel.hpp>
#include <tools/viewer/screen.hpp>
#include <tools/viewer/script.hpp>
#include <tools/viewer/simulation.hpp>
#include <tools/viewer/window.hpp>

#include <cstdint>
#include <optional>

namespace nearfield::viewer {

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
