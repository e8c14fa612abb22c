#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/settings_options.hpp>
#include <tools/io/scene.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// The arguments of `nearfield scene`; texts are parsed when the command runs.
struct SceneArguments {
    std::string scene;
    std::optional<std::string> technique;
    bool strict = false;
    SettingsArguments settings;
    std::optional<std::string> json;
};

/// Adds the command `scene` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments);

/// Answers all queries of a scene in one batch. Returns the exit status: bad shapes and queries are
/// listed on the standard error and the others answered. Throws InputError, LibraryError or
/// std::runtime_error.
[[nodiscard]] int run_scene(const SceneArguments& arguments);

/// Says on the standard error what was skipped or dropped of the shapes of a scene.
void print_notes(const Scene& scene);

}  // namespace nearfield::tools
