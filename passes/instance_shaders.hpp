#pragma once

#include <passes/search_shaders.hpp>

namespace nearfield::passes {

/// The shaders that make the boxes of a world's instances, and the levels above them.
struct InstanceShaders {
    InstanceShaders(const gpu::Device& device, const ComputeLayout& layout);

    ComputeShader boxes;
    ComputeShader levels;
};

}  // namespace nearfield::passes
