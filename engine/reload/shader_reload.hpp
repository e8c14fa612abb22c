#pragma once

#include <engine/gpu/device.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace nearfield::reload {

/// Compiles the shaders of the library from their sources again, for who works on them. What
/// changed is found by content: of a shader, and of everything that it includes.
class ShaderReload {
public:
    explicit ShaderReload(const gpu::Device& device) : device_(&device) {}

    /// Compiles what changed since it was compiled here last, and has the device use what comes out
    /// otherwise than what is in use: for pipelines that are made from now on. Returns how many
    /// shaders that are. `folder`: of the sources; null: the one the library was built from. Throws
    /// Failure (invalid_shader) with the compiler's words, which it logs too; nothing has changed
    /// then.
    [[nodiscard]] std::uint32_t compile_changed(const char* folder);
    /// What came of the last compile_changed() is of no use: goes back to what was before it, once.
    void take_back();

private:
    using Texts = std::map<std::string, std::string>;  // by file

    [[nodiscard]] std::uint32_t compile(const std::filesystem::path& folder, const Texts& texts);

    const gpu::Device* device_;
    Texts compiled_;      // the text that each shader was compiled from last, with what it includes
    Texts former_texts_;  // before the last compile_changed()
    gpu::ShaderWords former_words_;
};

}  // namespace nearfield::reload
