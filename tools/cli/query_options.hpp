#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/query.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

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
