#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace nearfield::gpu {

/// Reloaded SPIR-V that replaces what the library was built with; only in builds that reload
/// shaders.
class ShaderWords {
public:
    using Words = std::span<const std::uint32_t>;

    /// The words to make a pipeline from, given those that the library was built with.
    [[nodiscard]] Words in_use(Words built) const {
        const auto reloaded = reloaded_.find(built.data());
        return reloaded == reloaded_.end() ? built : Words(reloaded->second);
    }
    void use(Words built, std::vector<std::uint32_t> words) {
        reloaded_[built.data()] = std::move(words);
    }

private:
    std::map<const std::uint32_t*, std::vector<std::uint32_t>> reloaded_;  // by the built words
};

}  // namespace nearfield::gpu
