#pragma once

#include <CLI/CLI.hpp>
#include <tools/commands/settings_options.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// What stands on the command line of `nearfield bench`.
struct BenchArguments {
    std::string scene;   ///< empty: the standard table
    std::string filter;  ///< of the standard table's rows
    bool paper = false;  ///< the paper's tables instead
    std::optional<std::string> curves;
    std::optional<std::string> technique;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::uint32_t frames = 50;
    std::uint32_t warm_up = 5;
};

/// Adds the command `bench` to the program; parsing fills `arguments`, which must outlive it.
CLI::App* add_bench_command(CLI::App& program, BenchArguments& arguments);

/// Runs the scene as one batch a frame, or the standard table, and reports medians. Throws
/// InputError, LibraryError or std::runtime_error.
void run_bench(const BenchArguments& arguments);

}  // namespace nearfield::tools
