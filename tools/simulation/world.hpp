#pragma once

#include <tools/simulation/proximity.hpp>
#include <tools/simulation/scene.hpp>

#include <cstdint>

namespace nearfield::simulation {

enum class Response { penalty, backtracking };

/// The energies of a scene, in mass * length^2 / time^2.
struct Energies {
    double kinetic = 0.0;
    double potential = 0.0;  ///< in gravity and attraction
    double elastic = 0.0;    ///< in deformed bodies
    double contact = 0.0;    ///< in the springs of the penalty response

    [[nodiscard]] double total() const { return kinetic + potential + elastic + contact; }
};

/// The results of a frame.
struct FrameReport {
    double time = 0.0;  ///< simulated time at its end
    Energies energies;  ///< at its end
    Proximity::Count queries;
    std::size_t contacts = 0;        ///< points with forces or impulses, over all steps
    double worst_penetration = 0.0;  ///< the greatest point depth found by any query
    std::size_t events = 0;          ///< for backtracking
    std::size_t stopped = 0;
};

/// Runs a scene frame by frame, deterministically.
class World {
public:
    /// Throws std::invalid_argument if the response is backtracking and bodies touch or overlap.
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

}  // namespace nearfield::simulation
