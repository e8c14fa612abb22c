#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::passes {

/// Distance fields of the compute technique (shaders/fields.h). The device lists the edges of B
/// that can be nearest in each block of 16 x 16 cells, from coarse to fine; the cells of a block
/// search its list, and masks tell their signs. Each dispatch covers all fields of a tile batch. On
/// a GPU, which has more threads than there are lists, a workgroup makes a list. On a software
/// driver one thread does, and eight lists share the instructions that find where they are; there a
/// frame of 1,000 small fields takes 1.2 times as long with workgroups of eight threads.
class Fields {
public:
    Fields(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// The buffers of the passes; `input`: shapes and tiles; `crowd`: the arguments of the dispatch
    /// for crowded blocks.
    struct Buffers {
        graph::Handle input;
        graph::Handle scratch;
        graph::Handle crowd;
    };
    /// What the passes write of cells: signed distances, nearest features.
    struct Cells {
        bool values = false;
        bool features = false;
    };
    /// What a pass writes that searches place by place: the number of places for which that took
    /// too long, and the results.
    struct Output {
        graph::Handle long_searches;
        graph::Handle field;
    };
    /// Adds the passes for cells. The masks have the edges of the fields already.
    void declare_cells(TileGraph& graph, Buffers buffers, const Cells& cells, Output& output) const;
    /// Adds the pass for points of fields; it writes the same words as ResolveField.
    void declare_points(TileGraph& graph, graph::Handle input, Output& output) const;

private:
    /// A pass that makes a list for each region, quarter or block.
    struct ListPass {
        const char* name;
        ComputeShader shader;
        std::uint32_t device_input::FieldWork::*squares;  ///< their number
    };
    static std::vector<ListPass> make_lists(const gpu::Device& device,
                                            const graph::ComputeLayout& layout, bool by_groups);
    /// Adds the passes that list edges.
    void declare_lists(TileGraph& graph, Buffers& buffers) const;

    ComputeShader rows_;
    bool lists_by_groups_;
    std::vector<ListPass> lists_;  ///< the last one also counts crowded blocks
    ComputeShader values_;
    ComputeShader features_;
    ComputeShader crowded_;
    ComputeShader points_;
};

}  // namespace nearfield::passes
