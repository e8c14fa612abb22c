#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/options.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/values.hpp>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The arguments of `nearfield scene`; texts are parsed when the command runs.
struct SceneArguments {
    std::vector<std::string> files;
    std::optional<std::string> technique;
    bool strict = false;
    bool query_times = false;
    // These are for outlines.
    std::vector<std::string> queries;
    std::optional<double> tolerance;
    bool hits_only = false;
    std::optional<double> deviation;
    std::optional<FillRule> fill_rule;
    std::optional<double> clean_width;
    std::optional<double> offset;
    std::optional<LengthUnit> unit;
    SettingsArguments settings;
    std::optional<std::string> json;
};

/// Adds the command `scene` to the program. Parsing fills `arguments`, which must outlive it.
CLI::App* add_scene_command(CLI::App& program, SceneArguments& arguments);

/// Answers all queries of a scene, or of all pairs of the items of outlines, in one batch. Returns
/// the exit status: bad shapes and queries are listed on the standard error and the others
/// answered. Throws InputError, LibraryError or std::runtime_error.
[[nodiscard]] int run_scene(const SceneArguments& arguments);

/// Says on the standard error what was skipped or dropped of the shapes of a scene.
void print_notes(const Scene& scene);

}  // namespace nearfield::tools
