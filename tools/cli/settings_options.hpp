#pragma once

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>
#include <tools/cli/thread_team.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace nearfield::tools {

/// The context settings on the command line.
struct SettingsArguments {
    std::optional<std::string> boxes;
    std::optional<std::uint32_t> height;
    std::optional<std::string> costs;
    std::shared_ptr<ThreadTeam> threads;  // null for a single thread
};

/// Adds the options --boxes, --height, --costs and --threads. Parsing fills `arguments`, which must
/// outlive it.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// Converts the arguments into context settings, which use the threads of `arguments`. Throws
/// InputError.
[[nodiscard]] Settings parse_settings(const SettingsArguments& arguments);

}  // namespace nearfield::tools
