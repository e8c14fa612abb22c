#pragma once

#include <CLI/CLI.hpp>
#include <tools/commands/settings_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// What stands on the command line of `nearfield query`.
struct QueryArguments {
    std::string type;
    std::string file_a;
    std::string file_b;
    std::optional<std::string> tolerance;
    std::optional<std::string> deviation;
    std::optional<std::string> pose_a;
    std::optional<std::string> pose_b;
    std::optional<std::string> end_pose_a;
    std::optional<std::string> end_pose_b;
    std::optional<std::string> time_bound;
    std::optional<std::string> most_steps;
    std::optional<std::string> most_work;
    std::optional<std::string> technique;
    std::optional<std::string> strategy;
    std::optional<std::string> kind;
    std::optional<std::string> points;
    std::optional<std::string> rectangle;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::optional<std::string> image;
    std::optional<std::string> field;
    std::optional<std::string> contact_distance;
    std::optional<std::string> normals;
    std::optional<std::string> sign;
    std::optional<std::string> gradient;
    std::optional<std::string> gradient_field;
    std::optional<std::string> features;
    std::optional<std::string> show;
    std::vector<std::string> at;
    bool tiles = false;
};

/// Adds the command `query` to the program; parsing fills `arguments`, which must outlive it.
CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments);

/// Answers the query and writes what was asked for. Throws InputError, LibraryError or
/// std::runtime_error.
void run_query(const QueryArguments& arguments);

}  // namespace nearfield::tools
