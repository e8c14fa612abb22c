#pragma once

#include <tools/commands/settings_options.hpp>
#include <tools/input/query_request.hpp>
#include <tools/input/values.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// What stands on the command line of `nearfield query`.
struct QueryArguments {
    QueryRequest request;  ///< the kind, and what an option says whatever the others are
    std::string file_a;
    std::string file_b;
    std::optional<double> deviation;
    DegreesPose pose_a;
    DegreesPose pose_b;
    std::optional<DegreesPose> end_pose_a;
    std::optional<DegreesPose> end_pose_b;
    std::optional<Technique> technique;
    std::optional<IntersectionStrategy> strategy;
    std::optional<SignEncoding> sign;
    std::optional<GradientMethod> gradient;
    std::vector<std::string> at;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::optional<std::string> image;
    std::optional<std::string> field;
    std::optional<std::string> gradient_field;
    std::optional<std::string> features;
    bool tiles = false;
};

/// Answers the query and writes what was asked for. Throws InputError, LibraryError or
/// std::runtime_error.
void run_query(const QueryArguments& arguments);

}  // namespace nearfield::tools
