#pragma once

#include <nearfield/context.hpp>

#include <tools/simulation/world.hpp>
#include <tools/viewer/drag.hpp>

#include <cstdint>
#include <functional>
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

/// A running scene that the user can drag bodies in.
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
    simulation::FrameReport advance() { return world_->advance(); }

    [[nodiscard]] const Choices& choices() const { return choices_; }
    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] simulation::World& world() { return *world_; }
    [[nodiscard]] const simulation::Scene& scene() const { return world_->scene(); }
    [[nodiscard]] double time() const { return begun_at_ + world_->time(); }
    [[nodiscard]] Drag& drag() { return drag_; }

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
    std::optional<simulation::World> world_;
};

}  // namespace nearfield::viewer
