#pragma once

#include <tools/cli/gpu_times.hpp>
#include <tools/cli/table_report.hpp>

#include <ostream>
#include <span>

namespace nearfield::tools {

/// Writes the tables, and from which row on the device is faster, in Markdown.
void write_gpu_tables(std::ostream& stream, std::span<const GpuRow> rows,
                      const Surroundings& surroundings);
/// Writes the same as JSON with a final line feed.
void write_gpu_json(std::ostream& stream, std::span<const GpuRow> rows,
                    const Surroundings& surroundings);

}  // namespace nearfield::tools
