#include <tools/simulation/plane.hpp>
#include <tools/viewer/script.hpp>

#include <algorithm>
#include <cmath>

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

}  // namespace nearfield::viewer
