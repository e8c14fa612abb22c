#pragma once

#include <SDL.h>
#include <tools/rendering/drawing.hpp>
#include <tools/rendering/vulkan_painter.hpp>

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

}  // namespace nearfield::viewer
