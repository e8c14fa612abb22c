#pragma once

#include <tools/viewer/findings.hpp>
#include <tools/viewer/simulation.hpp>

#include <string>

namespace nearfield::viewer {

/// What the user asks of the viewer.
struct Wishes {
    Choices choices;
    Overlays overlays;
    bool running = true;
    bool step = false;     ///< one frame
    bool restart = false;  ///< the scene, from its beginning
};

/// What the panel tells.
struct Reading {
    std::string device;
    double time = 0.0;       ///< of the scene, in seconds
    double tolerance = 0.0;  ///< d as it is
    std::size_t objects = 0;
    std::size_t lines = 0;
    dynamics::FrameReport frame;  ///< the last one
    Findings findings;
    std::string notice;  ///< why something did not happen; empty otherwise
};

/// How much of the window's left side the panel takes, pixels.
inline constexpr float panel_width = 330.0F;

/// Adds the panel to the Gui's frame, for a window so many pixels high, and changes the wishes as
/// the user does.
void add_panel(Wishes& wishes, const Reading& reading, float height);

}  // namespace nearfield::viewer
