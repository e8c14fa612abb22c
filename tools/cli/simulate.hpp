#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/options.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// The arguments of `nearfield simulate`.
struct SimulateArguments {
    std::string scene;
    std::optional<std::string> response;
    std::uint32_t frames = 300;
    std::optional<std::uint32_t> bodies;
    std::optional<std::string> tolerance;
    std::optional<std::string> technique;
    SettingsArguments settings;
    std::optional<std::string> image;
    std::uint32_t every = 1;  ///< draws one of this many frames
    std::optional<std::string> video;
    bool field = false;
    std::optional<std::string> json;
};

/// Adds the command `simulate` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_simulate_command(CLI::App& program, SimulateArguments& arguments);

/// Runs a scene frame by frame, draws it and reports on it; returns the exit status. After Ctrl-C,
/// on the frames that are done. Throws InputError, LibraryError or std::runtime_error.
[[nodiscard]] int run_simulate(const SimulateArguments& arguments);

}  // namespace nearfield::tools
