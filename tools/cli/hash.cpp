#include <tools/cli/hash.hpp>
#include <tools/hash/sections.hpp>

#include <iostream>

namespace nearfield::tools {

CLI::App* add_hash_command(CLI::App& program, HashArguments& arguments) {
    CLI::App* const command = program.add_subcommand(
        "hash",
        "Print hashes of the answers of technique cpu to fixed queries, by section. They are the "
        "same on every machine");
    command->add_flag("--quick", arguments.quick,
                      "Only the sections that take seconds on a slow machine");
    return command;
}

void run_hash(const HashArguments& arguments) {
    hash::print_hashes(hash::cpu_context, arguments.quick, std::cout);
}

}  // namespace nearfield::tools
