#pragma once

#include <tools/simulation/clearance_scene.hpp>

#include <ostream>
#include <vector>

namespace nearfield::tools {

/// What a run of a scene of clearances asked and found, at least one frame.
struct ClearanceReport {
    const simulation::ClearanceScene& scene;
    std::vector<simulation::ClearanceFrame> frames;
};

/// Writes the run as JSON with a final line feed.
void write_clearance_json(std::ostream& stream, const ClearanceReport& report);

/// Writes the run as text, one item per line.
void write_clearance_summary(std::ostream& stream, const ClearanceReport& report);

}  // namespace nearfield::tools
