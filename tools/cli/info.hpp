#pragma once

#include <CLI/CLI.hpp>

namespace nearfield::tools {

/// Adds the command `info` to the program.
CLI::App* add_info_command(CLI::App& program);

/// Prints the version and every device with its status: usable, or what it lacks. Returns the exit
/// status.
[[nodiscard]] int run_info();

}  // namespace nearfield::tools
