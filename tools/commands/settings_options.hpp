#pragma once

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>
#include <tools/commands/thread_team.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace nearfield::tools {

/// Settings of a context, as the command line has them.
struct SettingsArguments {
    std::optional<std::string> boxes;
    std::optional<std::uint32_t> height;
    std::optional<std::string> costs;
    std::shared_ptr<ThreadTeam> threads;  // null for one
};

/// Adds the options --boxes, --height, --costs and --threads; parsing fills `arguments`, which must
/// outlive it.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// The settings of a context they ask for; its threads are those of `arguments`. Throws InputError.
[[nodiscard]] Settings parse_settings(const SettingsArguments& arguments);

}  // namespace nearfield::tools
