#pragma once

#include <engine/gpu/device.hpp>
#include <engine/plan/pair_question.hpp>
#include <passes/instance_shaders.hpp>
#include <passes/search_shaders.hpp>

namespace nearfield::passes {

/// The shaders of all searches between the pairs of a world's instances (PairSearch).
struct PairShaders {
    /// `instance_shaders` have to stay.
    PairShaders(const gpu::Device& device, const ComputeLayout& layout,
                const InstanceShaders* instance_shaders);

    const InstanceShaders& instances;
    SearchShaders search;
    ComputeShader counts;
    ComputeShader lists;
    ComputeShader directions;
    ComputeShader summaries;
    ComputeShader contacts;
    ComputeShader crossings;
    ComputeShader verdicts;
    ComputeShader rows;
};

}  // namespace nearfield::passes
