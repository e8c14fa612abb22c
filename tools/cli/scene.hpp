#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/settings_options.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// The arguments of `nearfield scene`; texts are parsed when the command runs.
struct SceneArguments {
    std::string scene;
    std::optional<std::string> technique;
    SettingsArguments settings;
    std::optional<std::string> json;
};

/// Adds the command `scene` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments);

/// Answers all queries of a scene in one batch. Throws InputError, LibraryError or
/// std::runtime_error.
void run_scene(const SceneArguments& arguments);

}  // namespace nearfield::tools
