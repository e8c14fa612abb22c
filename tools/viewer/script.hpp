#pragma once

#include <SDL.h>
#include <tools/drawing/view.hpp>

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

}  // namespace nearfield::viewer
