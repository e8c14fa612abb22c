#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace nearfield::gpu {

/// SPIR-V that shaders were reloaded with, in place of what the library was built with; only in
/// builds that reload shaders.
class ShaderWords {
public:
    using Words = std::span<const std::uint32_t>;

    /// What to make a pipeline of, for words that the library was built with.
    [[nodiscard]] Words in_use(Words built) const {
        const auto reloaded = reloaded_.find(built.data());
        return reloaded == reloaded_.end() ? built : Words(reloaded->second);
    }
    void use(Words built, std::vector<std::uint32_t> words) {
        reloaded_[built.data()] = std::move(words);
    }

private:
    std::map<const std::uint32_t*, std::vector<std::uint32_t>> reloaded_;  // by what was built
};

}  // namespace nearfield::gpu
