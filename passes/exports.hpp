#pragma once

#include <engine/device_input/resident_outputs.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_shader.hpp>

#include <cstdint>
#include <span>

/// \file The last passes of a batch with results that stay on the device. They are graphs of their
/// own because what they write belongs to the batch and not to the compiled graph of a tile batch.
/// Each also writes the output's header (HeaderData), behind which the passes keep their blocks.
/// A pass that is dispatched for each of several runs of what it reads is given resources for each.

namespace nearfield::passes {

/// Copies words of tile batches with resident outputs to the read-back buffer.
struct CopyBack {
    explicit CopyBack(const gpu::Device& device);

    graph::RecordedGraph<std::span<const VkBufferCopy>> graph;
    graph::Handle words;
    graph::Handle read_back;
};

/// Copies a header, once all of an output is written, to where the host wants it.
struct CopyHeader {
    explicit CopyHeader(const gpu::Device& device);

    struct Input {};

    graph::RecordedGraph<Input> graph;
    graph::Handle header;  ///< nearfield's own
    graph::Handle target;
};

/// Copies the resolved cells of a field to images for the host's shaders. Leaves the images in the
/// layout in which these read them, or in the one that the host asked for where they are its own.
struct ExportField {
    ExportField(const gpu::Device& device, const graph::ComputeLayout& layout);

    struct Input {
        std::span<const device_input::FieldPartOutput> parts;
        std::span<const graph::BoundResources> resources;  ///< by part
    };

    ComputeShader shader;
    graph::RecordedGraph<Input> graph;
    graph::Handle words;  ///< of fields, as written by the tile batches
    graph::Handle tables;
    graph::Handle signed_distance;
    graph::Handle feature;
    graph::Handle header;
};

/// The records of what PairSearch has found in one direction of a query: count, place, write. It
/// follows the search of the part that has the direction; the directions of a query follow each
/// other.
struct ExportRecords {
    ExportRecords(const gpu::Device& device, const graph::ComputeLayout& layout);

    struct Input {
        /// Those of the search, with the direction in its part, the flags of the records, their
        /// capacity and the frame.
        shaders::SearchPush push;
        std::uint32_t blocks = 0;  ///< of points
    };

    ComputeShader shader;
    graph::RecordedGraph<Input> graph;
    graph::Handle shapes;
    graph::Handle scratch;
    graph::Handle header;
    graph::Handle records;  ///< with their summary
};

/// The samples of an intersection: box, count, place, write.
struct ExportSamples {
    ExportSamples(const gpu::Device& device, const graph::ComputeLayout& layout);

    struct Input {
        const device_input::SamplesOutput* samples = nullptr;
        std::span<const device_input::SampleRunOutput> runs;
        std::span<const shaders::SampleTileData> tiles;    ///< of all queries
        std::span<const graph::BoundResources> resources;  ///< by run, and at least one
    };

    ComputeShader shader;
    graph::RecordedGraph<Input> graph;
    graph::Handle summaries;  ///< as written by the tile batches
    graph::Handle masks;      ///< with the edges of cells
    graph::Handle tables;
    graph::Handle header;
    graph::Handle samples;  ///< with their summary
};

}  // namespace nearfield::passes
