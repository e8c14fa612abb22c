#pragma once

#include <nearfield/cost.hpp>

#include <ostream>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// Reads a file written by `nearfield calibrate`. Throws InputError with file, place and reason.
[[nodiscard]] CostModel read_cost_model(const std::string& file);

/// Writes a model as JSON. `device` is for people; nothing reads it back.
void write_cost_model(std::ostream& stream, const CostModel& costs, std::string_view device);

}  // namespace nearfield::tools
