#pragma once

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// Settings of a context, as the command line has them.
struct SettingsArguments {
    std::optional<std::string> boxes;
    std::optional<std::uint32_t> height;
    std::optional<std::string> costs;
};

/// Adds the options --boxes, --height and --costs; parsing fills `arguments`, which must outlive
/// it.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// The settings of a context they ask for. Throws InputError.
[[nodiscard]] Settings parse_settings(const SettingsArguments& arguments);

}  // namespace nearfield::tools
