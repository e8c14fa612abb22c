#pragma once

#include <CLI/CLI.hpp>

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

}  // namespace nearfield::tools
