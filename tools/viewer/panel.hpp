#pragma once

#include <tools/viewer/findings.hpp>
#include <tools/viewer/simulation.hpp>

#include <optional>
#include <string>

namespace nearfield::viewer {

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
