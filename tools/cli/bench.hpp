#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/settings_options.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// The arguments of `nearfield bench`.
struct BenchArguments {
    std::string scene;   ///< if empty, the standard table is measured
    std::string filter;  ///< selects rows of the standard table
    bool paper = false;  ///< measures the paper's tables instead
    bool gpu = false;    ///< measures the work from which a GPU is faster, instead
    std::optional<std::string> curves;
    std::optional<std::string> technique;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::uint32_t frames = 50;
    std::uint32_t warm_up = 5;
    bool keep = false;  ///< a frame passes poses alone, no shapes
};

/// Adds the command `bench` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_bench_command(CLI::App& program, BenchArguments& arguments);

/// Runs the scene as one batch per frame, or the standard table, and reports medians. Throws
/// InputError, LibraryError (cancelled, after Ctrl-C) or std::runtime_error.
void run_bench(const BenchArguments& arguments);

}  // namespace nearfield::tools
