#pragma once

#include <nearfield/context.hpp>

#include <tools/dynamics/world.hpp>
#include <tools/viewer/drag.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace nearfield::viewer {

/// What the user chooses of a simulation.
struct Choices {
    std::string scene = "map";
    dynamics::Response response = dynamics::Response::penalty;
    Technique technique = Technique::automatic;
    double tolerance = 0.0;  ///< d; 0: as the scene has it
    std::uint32_t hierarchy_height = Settings{}.hierarchy_height;

    friend bool operator==(const Choices&, const Choices&) = default;
};

/// A scene that runs, with a hand in it.
class Simulation {
public:
    /// Throws tools::InputError where there is no such scene, or none with that response;
    /// tools::LibraryError where the library refuses.
    Simulation(const HostDevice& host, const Settings& settings, const Choices& choices);
    ~Simulation() = default;
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Goes on as chosen: bodies stay where they are, unless another scene is chosen, or
    /// backtracking while they overlap; these start anew. Throws tools::InputError, and leaves all
    /// as it was, where that cannot be.
    void choose(const Choices& choices);
    void restart();
    dynamics::FrameReport advance() { return world_->advance(); }

    [[nodiscard]] const Choices& choices() const { return choices_; }
    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] dynamics::World& world() { return *world_; }
    [[nodiscard]] const dynamics::Scene& scene() const { return world_->scene(); }
    [[nodiscard]] double time() const { return begun_at_ + world_->time(); }
    [[nodiscard]] Drag& drag() { return drag_; }

private:
    void begin(dynamics::Scene scene, double time);

    HostDevice host_;
    Settings settings_;
    Choices choices_;
    std::optional<Context> context_;
    std::function<void(double)> act_;  // the scene's own
    double own_tolerance_ = 0.0;       // likewise
    double begun_at_ = 0.0;            // time of the scene when the world began
    Drag drag_;
    std::optional<dynamics::World> world_;
};

}  // namespace nearfield::viewer
