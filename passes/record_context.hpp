#pragma once

#include <engine/device_input/compute_batch_builder.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_shader.hpp>

#include <cstdint>

namespace nearfield::passes {

/// What the passes of a tile batch of the compute technique are recorded from, beside the resources
/// that they bind.
struct RecordContext {
    const device_input::ComputeBatch& batch;
    std::uint32_t shape_units;      ///< of the shapes before the work of fields and masks
    std::uint32_t sample_capacity;  ///< space in the read-back, in samples
};

/// The graph of such a tile batch.
using TileGraph = graph::RecordedGraph<RecordContext>;

}  // namespace nearfield::passes
