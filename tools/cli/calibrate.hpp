#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

struct CalibrateArguments {
    std::optional<std::string> file;
};

/// Adds the command to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_calibrate_command(CLI::App& program, CalibrateArguments& arguments);

/// Measures the costs of the techniques on this machine. Throws InputError, LibraryError.
void run_calibrate(const CalibrateArguments& arguments);

}  // namespace nearfield::tools
