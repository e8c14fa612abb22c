#pragma once

#include <CLI/CLI.hpp>
#include <tools/commands/query.hpp>

namespace nearfield::tools {

/// Adds the command `query` to the program, with a subcommand for each kind of query that has the
/// options of that kind; parsing fills `arguments`, which must outlive it. Options that cannot be
/// understood leave CLI::App::parse as InputError.
CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments);

}  // namespace nearfield::tools
