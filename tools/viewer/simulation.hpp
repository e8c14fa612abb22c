#pragma once

#include <nearfield/context.hpp>
#include <nearfield/host.hpp>

#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/world.hpp>
#include <tools/viewer/drag.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace nearfield::viewer {

/// The user's choices for a simulation.
struct Choices {
    std::string scene = "map";
    simulation::Response response = simulation::Response::penalty;
    Technique technique = Technique::automatic;
    double tolerance = 0.0;  ///< d; 0: the scene's own
    std::uint32_t hierarchy_height = Settings{}.hierarchy_height;

    friend bool operator==(const Choices&, const Choices&) = default;
};

/// A running scene that the user can drag something in: bodies in a world of theirs, or a scene of
/// clearances.
class Simulation {
public:
    /// Throws tools::InputError if the scene does not exist or does not support the response;
    /// tools::LibraryError if the library rejects something.
    Simulation(const HostDevice& host, const Settings& settings, const Choices& choices);
    ~Simulation() = default;
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Applies the choices. Bodies stay where they are, except that the simulation restarts for
    /// another scene, or for backtracking while bodies overlap. If the choices are invalid, throws
    /// tools::InputError and changes nothing.
    void choose(const Choices& choices);
    void restart();
    [[nodiscard]] const Choices& choices() const { return choices_; }
    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] const Rectangle& view() const;  ///< the part of the world to show
    [[nodiscard]] double time() const;            ///< of the scene, seconds

    /// What the mouse does with the scene.
    void grab(Vector2 point);
    void drag_to(Vector2 point);
    void release();

    /// The scene of clearances, if that is what was chosen; else null. The members below are about
    /// scenes of bodies.
    [[nodiscard]] simulation::ClearanceScene* clearances() { return clearances_.get(); }
    simulation::FrameReport advance() { return world_->advance(); }
    [[nodiscard]] simulation::World& world() { return *world_; }
    [[nodiscard]] const simulation::Scene& scene() const { return world_->scene(); }
    [[nodiscard]] const Drag& drag() const { return drag_; }

private:
    void begin(simulation::Scene scene, double time);

    HostDevice host_;
    Settings settings_;
    Choices choices_;
    std::optional<Context> context_;
    std::function<void(double)> act_;  // the scene's own
    double own_tolerance_ = 0.0;       // likewise
    double begun_at_ = 0.0;            // scene time when the world began
    Drag drag_;
    // One of the two:
    std::optional<simulation::World> world_;
    std::unique_ptr<simulation::ClearanceScene> clearances_;
};

}  // namespace nearfield::viewer
