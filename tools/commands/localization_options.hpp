#pragma once

#include <nearfield/context.hpp>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::tools {

/// How localisation is done, as the command line has it.
struct LocalizationArguments {
    std::optional<std::string> boxes;
    std::optional<std::uint32_t> height;
};

/// Adds the options --boxes and --height; parsing fills `arguments`, which must outlive it.
void add_localization_options(CLI::App& command, LocalizationArguments& arguments);

/// The settings of a context they ask for. Throws InputError.
[[nodiscard]] Settings parse_settings(const LocalizationArguments& arguments);

}  // namespace nearfield::tools
