#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nearfield::reload {

/// The compiler's output for a shader.
struct Compilation {
    std::vector<std::uint32_t> words;     ///< SPIR-V; empty where it did not compile
    std::vector<std::string> complaints;  ///< the compiler's messages, by line
};

/// Compiles FOLDER/FILE as the build does, with the compiler that the library was built with, and
/// waits for it. Throws StatusException (unavailable) if the compiler cannot be run.
[[nodiscard]] Compilation compile(const std::filesystem::path& folder, const std::string& file);

}  // namespace nearfield::reload
