#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/settings_options.hpp>
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

/// The files into which a scene has the records of its queries written.
class WorldValuesFiles {
public:
    /// `json`: the file of the answers; "-" is the standard output. Throws InputError for a file
    /// that cannot be written, or that would replace an input or another output.
    WorldValuesFiles(const Scene& scene, const std::optional<std::string>& json);

    /// Writes the records of the answers that there are. Other files are left as they are.
    void write(std::span<const SceneAnswer> answers);

    /// Throws std::runtime_error if writing failed.
    void commit();

private:
    struct File {
        explicit File(const std::string& path) : output(path) {}
        OutputFile output;
        bool is_written = false;
    };
    std::map<std::string, File> files_;  ///< by path
};

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
