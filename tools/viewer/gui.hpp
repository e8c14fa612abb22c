#pragma once

#include <SDL.h>
#include <tools/render/mesh.hpp>
#include <tools/render/vulkan_painter.hpp>

namespace nearfield::viewer {

/// Dear ImGui with SDL's events, drawn by our painter.
class Gui {
public:
    explicit Gui(SDL_Window* window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Its letters, for the painter.
    [[nodiscard]] static tools::Letters letters();
    static void handle(const SDL_Event& event);
    /// The mouse, or the keys, are for a widget.
    [[nodiscard]] static bool wants_mouse();
    [[nodiscard]] static bool wants_keys();

    /// Widgets are added after this and before add_to().
    static void begin();
    static void add_to(tools::Mesh& mesh);
};

}  // namespace nearfield::viewer
