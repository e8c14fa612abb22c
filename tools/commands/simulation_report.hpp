#pragma once

#include <tools/dynamics/world.hpp>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A run of a scene.
struct SimulationReport {
    std::string scene;
    std::string response;
    std::string technique;
    std::string device;
    double tolerance = 0.0;
    std::size_t objects = 0;
    std::size_t lines = 0;
    unsigned steps = 0;  ///< a frame
    std::vector<dynamics::FrameReport> frames;
};

/// Writes the whole run as JSON, with a line feed at its end.
void write_simulation_json(std::ostream& stream, const SimulationReport& report);

/// Writes it for people, an item a line.
void write_simulation_summary(std::ostream& stream, const SimulationReport& report);

}  // namespace nearfield::tools
