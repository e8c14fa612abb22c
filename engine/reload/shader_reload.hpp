#pragma once

#include <engine/gpu/device.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace nearfield::reload {

/// Development aid: recompiles the library's shaders from their sources. Changes are detected by
/// content: of a shader and of everything that it includes.
class ShaderReload {
public:
    explicit ShaderReload(const gpu::Device& device) : device_(&device) {}

    /// Compiles the shaders that changed since the last call; pipelines made from now on use those
    /// whose words differ from the ones in use. Returns the number of such shaders. `folder`: of
    /// the sources; null: the one the library was built from. Throws StatusException
    /// (invalid_shader) with the compiler's messages, which it also logs; then nothing has changed.
    [[nodiscard]] std::uint32_t compile_changed(const char* folder);
    /// Reverts the last compile_changed(), whose result was unusable; once.
    void take_back();

private:
    using Texts = std::map<std::string, std::string>;  // by file

    [[nodiscard]] std::uint32_t compile(const std::filesystem::path& folder, const Texts& texts);

    const gpu::Device* device_;
    Texts compiled_;      // by shader: the text last compiled, with its includes
    Texts former_texts_;  // before the last compile_changed()
    gpu::ShaderWords former_words_;
};

}  // namespace nearfield::reload
