#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/push.h>

namespace nearfield::passes {

/// The passes that take the poses of a world's instances from a buffer of the host's, in a separate
/// graph; PairSearch follows them in the same commands.
struct PairPoses {
    PairPoses(const gpu::Device& device, const graph::ComputeLayout& layout);

    ComputeShader shader;
    /// Recorded from push constants without `first`, beside the resources.
    graph::RecordedGraph<shaders::PosePush> graph;
    graph::Handle poses;  ///< with the host's uses of it
    graph::Handle shapes;
    graph::Handle instances;
    graph::Handle taken;  ///< the poses, for the CPU
};

}  // namespace nearfield::passes
