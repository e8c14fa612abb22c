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
    std::optional<std::uint32_t> memory_limit;  ///< MiB
    std::shared_ptr<ThreadTeam> threads;        // null for one
};

/// Adds the options --boxes, --height, --memory-limit and --threads; parsing fills
/// `arguments`, which must outlive it.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// Converts the arguments into context settings, which use the threads of `arguments`. Throws
/// InputError.
[[nodiscard]] Settings parse_settings(const SettingsArguments& arguments);

/// What to say after an error: which option raises the limit that it names; empty for others.
[[nodiscard]] std::string memory_hint(const std::string& error);

}  // namespace nearfield::tools
