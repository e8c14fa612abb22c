#pragma once

#include <engine/device_input/world_question.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/pair_search.hpp>

#include <shaders/world_queries.h>

#include <cstdint>

namespace nearfield::passes {

/// The passes that answer many questions of one kind about a world's instances, in a separate
/// graph: boxes of the instances and the levels above them, as PairSearch has them; a walk over
/// these for each question; and a copy of the answers for the CPU.
struct WorldQueries {
    /// The shaders of the instances must stay.
    WorldQueries(const gpu::Device& device, const graph::ComputeLayout& layout,
                 const InstanceShaders* instance_shaders, device_input::WorldQuestion question);

    /// What they are recorded from, beside the resources that they bind.
    struct Input {
        VkBufferCopy copy{};             ///< of the answers
        shaders::WorldQueryPush push{};  ///< without `first`
    };

    ComputeShader shader;
    graph::RecordedGraph<Input> graph;
    graph::Handle shapes;
    graph::Handle instances;
    graph::Handle questions;
    graph::Handle scratch;
    graph::Handle answers;
};

}  // namespace nearfield::passes
