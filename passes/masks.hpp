#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The bit masks of the compute technique (shaders/compute_work.h), in its scratch memory: the
/// signs of fields, the volumes and boundaries of intersections, and the search for the samples
/// that two masks share. The device reads the shapes' own edges, chunk by chunk.
class Masks {
public:
    Masks(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Adds the pass that clears masks and the edges of cells, and the one that puts shapes into
    /// masks: of volumes it marks the edges. They are the first of all passes that use the scratch
    /// memory, and wait for earlier use of that memory on the device, so tile batches may follow
    /// each other in a command buffer or in a queue.
    void declare_shapes(TileGraph& graph, graph::Handle shapes, graph::Handle& scratch) const;
    /// Adds the pass that fills the rows of intersections and writes the same output as Collect.
    void declare_collect(TileGraph& graph, graph::Handle shapes, graph::Handle& scratch,
                         graph::Handle samples) const;

private:
    const gpu::Device* device_;
    ComputeShader shapes_;
    ComputeShader collect_;
};

}  // namespace nearfield::passes
