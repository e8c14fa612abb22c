#pragma once

#include <string>
#include <vector>

namespace nearfield::test {

/// A format with files that are read as they are.
struct FuzzFormat {
    std::string name;  ///< of the mutated files, whose extension decides about the format
    std::vector<std::string> files;
    std::vector<std::string> words;  ///< pieces that mutations insert
};

/// All formats that tools/io reads.
[[nodiscard]] std::vector<FuzzFormat> fuzz_formats();

}  // namespace nearfield::test
