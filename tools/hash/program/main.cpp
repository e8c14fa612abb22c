// The command `nearfield hash` by itself, for tools/scripts/same_bits.sh.

#include <tools/hash/sections.hpp>

#include <iostream>
#include <string_view>

int main(int count, char** arguments) {
    const bool quick = count > 1 && arguments[1] == std::string_view("--quick");
    nearfield::hash::print_hashes(nearfield::hash::cpu_context, quick, std::cout);
}
