#pragma once

#include <CLI/CLI.hpp>

namespace nearfield::tools {

struct HashArguments {
    bool quick = false;
};

/// Adds the command `hash` to the program. `arguments` is filled when the program parses.
CLI::App* add_hash_command(CLI::App& program, HashArguments& arguments);

/// Prints the hashes of the answers of Technique::cpu.
void run_hash(const HashArguments& arguments);

}  // namespace nearfield::tools
