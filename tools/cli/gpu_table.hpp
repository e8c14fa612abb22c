#pragma once

#include <nearfield/context.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// Measures the work from which the device is faster than the CPU: crowds of 420 to 42,000 objects,
/// all of which move, with their pairs listed by the CPU or found by the device, and fields of 256
/// to 4096 cells a side, by each technique. Prints tables in Markdown, and from how many pairs on
/// the device is faster. `filter`: only the rows whose names hold this text. Throws InputError,
/// LibraryError (no_device without one, cancelled after Ctrl-C) or std::runtime_error.
void run_gpu_table(const std::string& filter, const Settings& settings,
                   const std::optional<std::string>& json);

}  // namespace nearfield::tools
