#pragma once

#include <CLI/CLI.hpp>
#include <tools/cli/query.hpp>

namespace nearfield::tools {

/// Adds the command `query` to the program, with a subcommand for each kind of query that has the
/// options of that kind. Parsing fills `arguments`, which must outlive it. Invalid options throw
/// InputError from CLI::App::parse.
CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments);

}  // namespace nearfield::tools
