#pragma once

#include <SDL.h>
#include <tools/picture/view.hpp>

#include <optional>

namespace nearfield::viewer {

/// What the mouse does where there is no user: it presses at one place of the scene, moves to
/// another in the first half of the frames, and holds until the end.
struct Script {
    Vector2 from;
    Vector2 to;
    std::uint32_t frames = 0;

    /// Pushes this frame's events, which then come as those of a mouse do.
    void play(std::uint32_t frame, const tools::View& view) const;
};

}  // namespace nearfield::viewer
