#pragma once

#include <tools/dynamics/proximity.hpp>
#include <tools/dynamics/scene.hpp>

#include <cstdint>

namespace nearfield::dynamics {

enum class Response { penalty, backtracking };

/// What a scene holds of energy, in mass * length^2 / time^2.
struct Energies {
    double kinetic = 0.0;
    double potential = 0.0;  ///< in gravity and attraction
    double elastic = 0.0;    ///< in deformed bodies
    double contact = 0.0;    ///< in the springs of the penalty response

    [[nodiscard]] double total() const { return kinetic + potential + elastic + contact; }
};

/// What a frame came to.
struct FrameReport {
    double time = 0.0;  ///< of the simulation, at its end
    Energies energies;  ///< then
    Proximity::Count queries;
    std::size_t contacts = 0;        ///< points that pushed or were pushed, of all steps
    double worst_penetration = 0.0;  ///< the greatest point depth that any query found
    std::size_t events = 0;          ///< of backtracking
    std::size_t stopped = 0;
};

/// A scene that runs, frame by frame, always the same way.
class World {
public:
    /// Throws std::invalid_argument where the response is backtracking and bodies touch or overlap.
    World(Context& context, Scene scene, Response response,
          Technique technique = Technique::automatic);

    FrameReport advance();

    [[nodiscard]] Scene& scene() { return scene_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] Proximity& proximity() { return proximity_; }
    [[nodiscard]] Response response() const { return response_; }
    [[nodiscard]] double time() const { return time_; }

private:
    [[nodiscard]] Energies energies() const;
    void apply_surroundings();
    void step(double time, FrameReport& report);

    Scene scene_;
    Proximity proximity_;
    Response response_;
    double time_ = 0.0;
};

}  // namespace nearfield::dynamics
