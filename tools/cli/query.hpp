#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/options.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/values.hpp>

#include <optional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The arguments of `nearfield query`.
struct QueryArguments {
    QueryRequest request;  ///< the kind, and the options that can be read without the others
    std::string file_a;
    std::string file_b;
    std::optional<double> deviation;
    LengthUnit unit = LengthUnit::user;
    OutlineTreatment treatment;
    DegreesPose pose_a;
    DegreesPose pose_b;
    std::optional<DegreesPose> end_pose_a;
    std::optional<DegreesPose> end_pose_b;
    std::vector<std::string> at;
    SettingsArguments settings;
    std::optional<std::string> json;
    std::optional<std::string> image;
    std::optional<std::string> field;
    std::optional<std::string> gradient_field;
    std::optional<std::string> features;
    bool tiles = false;
};

/// Answers the query and writes the requested outputs; returns the exit status. If Ctrl-C ends the
/// search for a separation vector or time of impact, what it has found is written. Throws
/// InputError, LibraryError (cancelled, if Ctrl-C ends any other query) or std::runtime_error.
[[nodiscard]] int run_query(const QueryArguments& arguments);

/// Returns the words of a command line with the kind of a `query` command moved before its options.
/// Users may put options before the kind, but CLI11 reads a subcommand's options only after its
/// name.
[[nodiscard]] std::vector<std::string> with_kind_first(const CLI::App& query,
                                                       std::vector<std::string> words);

/// Call after CLI11 has rejected a `query` command line. Throws InputError if a better message is
/// possible: the kind is missing or unknown, or an option belongs to another kind.
void explain_refusal(const CLI::App& query);

/// Adds the command `query` to the program, with a subcommand for each kind of query that has the
/// options of that kind. Parsing fills `arguments`, which must outlive it. Invalid options throw
/// InputError from CLI::App::parse.
CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments);

}  // namespace nearfield::tools
