#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nearfield::reload {

/// What the compiler made of a shader.
struct Compilation {
    std::vector<std::uint32_t> words;     ///< SPIR-V; empty where it did not compile
    std::vector<std::string> complaints;  ///< what the compiler said, by line
};

/// Has the compiler that the library was built with compile FOLDER/FILE as the build does, and
/// waits for it. Throws Failure (unavailable) where it cannot be run.
[[nodiscard]] Compilation compile(const std::filesystem::path& folder, const std::string& file);

}  // namespace nearfield::reload
