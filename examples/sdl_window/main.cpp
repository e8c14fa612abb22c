#include "renderer.hpp"
#include "window.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
#include <cstdio>

// Two shapes that the mouse drags, and their contacts, in a stand-alone window with a swapchain, on
// a device that nearfield shares.

namespace {

using namespace nearfield::examples;

struct Options {
    int frames = 0;  ///< 0: until the window is closed
    std::string screenshot;
    std::array<double, 2> drag{0.0, 0.0};
    std::array<int, 2> resize{0, 0};
};

View view_of(const Window& window) {
    const vk::Extent2D extent = window.extent();
    return {static_cast<double>(extent.width), static_cast<double>(extent.height)};
}

void push_mouse(const Window& window, Uint32 type, const nearfield::Vector2& world) {
    const nearfield::Vector2 at = view_of(window).to_pixel(world);
    const auto x = static_cast<Sint32>(std::lround(at.x));
    const auto y = static_cast<Sint32>(std::lround(at.y));
    SDL_Event event{};
    event.type = type;
    if (type == SDL_MOUSEMOTION) {
        event.motion.x = x;
        event.motion.y = y;
    } else {
        event.button.x = x;
        event.button.y = y;
    }
    SDL_PushEvent(&event);
}

/// Simulated user input: drags in the first frames, resizes half-way.
void play(const Options& options, int frame, const Window& window) {
    const nearfield::Vector2 by{options.drag[0], options.drag[1]};
    if (frame == 0) {
        push_mouse(window, SDL_MOUSEBUTTONDOWN, drag_position(by, 0));
    } else if (frame <= drag_steps) {
        push_mouse(window, SDL_MOUSEMOTION, drag_position(by, frame));
    } else if (frame == drag_steps + 1) {
        push_mouse(window, SDL_MOUSEBUTTONUP, drag_position(by, drag_steps));
    }
    if (frame == options.frames / 2 && options.resize[0] > 0) {
        SDL_SetWindowSize(window.get(), options.resize[0], options.resize[1]);
    }
}

/// Returns false if the window was closed.
bool handle_events(const Window& window, Scene& scene) {
    const View view = view_of(window);
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        switch (event.type) {
            case SDL_QUIT:
                return false;
            case SDL_MOUSEBUTTONDOWN:
                scene.press(view.to_world({double(event.button.x), double(event.button.y)}));
                break;
            case SDL_MOUSEMOTION:
                scene.move(view.to_world({double(event.motion.x), double(event.motion.y)}));
                break;
            case SDL_MOUSEBUTTONUP:
                scene.release();
                break;
            default:
                break;
        }
    }
    return true;
}

void run(const Options& options) {
    Scene scene;
    const Window window("nearfield in a window", 640, 480);
    const vk::UniqueInstance instance = make_instance(window.extensions());
    const vk::UniqueSurfaceKHR surface = make_surface(window, *instance);
    const OwnDevice device(*instance, [&](vk::PhysicalDevice physical, std::uint32_t family) {
        return physical.getSurfaceSupportKHR(family, *surface) == VK_TRUE;
    });
    Renderer renderer(device, *instance, *surface, window.extent(), scene);

    for (int frame = 0; options.frames == 0 || frame < options.frames;) {
        if (options.frames != 0) {
            play(options, frame, window);
        }
        if (!handle_events(window, scene)) {
            return;
        }
        const vk::Extent2D extent = window.extent();
        if (extent.width == 0 || extent.height == 0) {
            SDL_WaitEvent(nullptr);  // nothing to draw to while minimised
            continue;
        }
        const bool is_last = frame + 1 == options.frames;
        if (renderer.draw(scene, extent, is_last ? options.screenshot : std::string())) {
            ++frame;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App application("Live contacts of two shapes in a window");
    // Enough for the scripted mouse, for the frames in flight, and for all of these again after a
    // resize.
    const int fewest = 2 * (drag_steps + 2 * static_cast<int>(Renderer::frames_in_flight));
    CLI::Option* frames =
        application.add_option("--frames", options.frames, "play a script and leave after so many")
            ->check(CLI::Range(fewest, 1'000'000));
    application.add_option("--drag", options.drag, "drag the star by this (world units)")
        ->delimiter(',')
        ->needs(frames);
    application.add_option("--resize", options.resize, "resize to this, half-way (pixels)")
        ->delimiter(',')
        ->check(CLI::Range(1, 16384))
        ->needs(frames);
    application.add_option("--screenshot", options.screenshot, "write the last frame (PNG)")
        ->needs(frames);
    try {
        application.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return application.exit(error) == 0 ? 0 : 2;
    }
    try {
        run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sdl_window: %s\n", error.what());
        return 1;
    }
    return 0;
}
