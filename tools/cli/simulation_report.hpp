#pragma once

#include <tools/simulation/world.hpp>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The results of a simulation run.
struct SimulationReport {
    std::string scene;
    std::string response;
    std::string technique;
    std::string device;
    double tolerance = 0.0;
    std::size_t objects = 0;
    std::size_t lines = 0;
    unsigned steps = 0;  ///< per frame
    std::vector<simulation::FrameReport> frames;
};

/// Writes the run as JSON with a final line feed.
void write_simulation_json(std::ostream& stream, const SimulationReport& report);

/// Writes the run as text, one item per line.
void write_simulation_summary(std::ostream& stream, const SimulationReport& report);

}  // namespace nearfield::tools
