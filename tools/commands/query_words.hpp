#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The words of a command line, those of `query` with the kind before its options: options may
/// stand before the kind, and CLI11 reads a subcommand's options only after its name.
[[nodiscard]] std::vector<std::string> with_kind_first(const CLI::App& query,
                                                       std::vector<std::string> words);

/// After CLI11 has refused a command line of `query`: throws InputError where there is more to say
/// than CLI11 does, of a kind that is missing or unknown, or of an option of another kind.
void explain_refusal(const CLI::App& query);

}  // namespace nearfield::tools
