#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/exports.hpp>

#include <shaders/push.h>

namespace nearfield::passes {

/// The passes that write what stays on the device of the pairs of a world, in a separate graph that
/// follows PairSearch in the same commands: rows and headers, and records.
struct ExportPairs {
    ExportPairs(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// What they are recorded from, beside the resources that they bind.
    struct Input {
        shaders::SearchPush search;  ///< of the part that was searched before
        shaders::ExportPairsPush pairs;
    };

    ComputeShader row_shader;
    ComputeShader record_shader;
    graph::RecordedGraph<Input> graph;
    // Of the search:
    graph::Handle shapes;
    graph::Handle instances;
    graph::Handle scratch;
    graph::Handle arguments;
    graph::Handle rows;
    // What stays:
    graph::Handle pairs;
    graph::Handle records;
    graph::Handle headers;
    CopyHeader copy_header;  ///< after all parts
};

}  // namespace nearfield::passes
