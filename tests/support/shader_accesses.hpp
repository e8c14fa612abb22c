#pragma once

#include <cstdint>
#include <map>
#include <span>

namespace nearfield::test_support {

/// What the code of a shader does to a buffer.
struct ShaderAccess {
    bool reads = false;
    bool writes = false;
};

/// By binding of set 0, what SPIR-V code does to storage buffers, whichever function does it.
[[nodiscard]] std::map<std::uint32_t, ShaderAccess> buffer_accesses(
    std::span<const std::uint32_t> code);

}  // namespace nearfield::test_support
