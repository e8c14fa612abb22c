#pragma once

#include <SDL.h>
#include <tools/rendering/drawing.hpp>
#include <tools/rendering/vulkan_painter.hpp>
#include <tools/viewer/findings.hpp>
#include <tools/viewer/simulation.hpp>

#include <optional>
#include <string>

namespace nearfield::viewer {

/// Dear ImGui with SDL's events, drawn by the tools' painter.
class Gui {
public:
    explicit Gui(SDL_Window* window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// The glyph image for the painter.
    [[nodiscard]] static tools::Letters letters();
    static void handle(const SDL_Event& event);
    /// True if a widget uses the mouse or the keyboard.
    [[nodiscard]] static bool wants_mouse();
    [[nodiscard]] static bool wants_keys();

    /// Widgets are added between this call and add_to().
    static void begin();
    static void add_to(tools::Mesh& mesh);
};

/// The user's settings in the viewer.
struct Wishes {
    Choices choices;
    Overlays overlays;
    bool running = true;
    bool step = false;     ///< runs one frame
    bool restart = false;  ///< restarts the scene from its beginning
};

/// The values that the panel shows.
struct Reading {
    std::string device;
    double time = 0.0;       ///< of the scene, in seconds
    double tolerance = 0.0;  ///< the current d
    std::size_t objects = 0;
    std::size_t lines = 0;
    simulation::FrameReport frame;  ///< the last report
    Findings findings;
    std::optional<simulation::ClearanceFrame> clearances;  ///< of a scene of clearances
    std::string notice;  ///< why something did not happen; otherwise empty
};

/// The width that the panel takes at the left of the window, pixels.
inline constexpr float panel_width = 330.0F;

/// Adds the panel to the Gui's frame, for a window of this height in pixels, and updates the wishes
/// from the user's input.
void add_panel(Wishes& wishes, const Reading& reading, float height);

}  // namespace nearfield::viewer
